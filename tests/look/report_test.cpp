// report.html, its pictures, and `hexwall view`.

#include <algorithm>
#include <array>
#include <filesystem>
#include <regex>
#include <set>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPNGReader.h>

#include "program/program_fails.h"

namespace hexwall::test {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

class Report : public ProgramFails {
 protected:
  Report() { write_surface(surface_, bifurcation_shape()); }

  static TriangleSurface bifurcation_shape() {
    return generate_shape(shape_from_name("bifurcation"), 0.3);
  }

  ChildResult mesh(const std::vector<std::string>& more = {},
                   const std::vector<std::string>& before = {}) const {
    std::vector<std::string> command = before;
    command.insert(command.end(),
                   {HEXWALL_PROGRAM, "mesh", surface_, "-o", output_, "--size", "0.7"});
    command.insert(command.end(), more.begin(), more.end());
    return run_child(command);
  }

  std::string page() const { return bytes_of(fs::path(output_) / "report.html"); }

  static bool can_draw() { return run_child({"sh", "-c", "command -v Xvfb"}).exit_code == 0; }
};

TEST_F(Report, HasTheNumbersOfTheRun) {
  ASSERT_EQ(mesh().exit_code, 0);
  const std::string html = page();
  const json report = json::parse(bytes_of(fs::path(output_) / "report.json"));
  for (const char* key : {"quads", "wall"}) {
    const json& count = key == std::string("quads") ? report[key]["count"] : report[key]["hexes"];
    EXPECT_NE(html.find("<b>" + count.dump() + "</b>"), std::string::npos) << key;
  }
  for (const json& opening : report["input"]["openings"]) {
    EXPECT_NE(html.find("<td>" + opening["name"].get<std::string>() + "</td>"), std::string::npos);
  }
  // A dot for each energy of the descent.
  const std::regex dot("<circle class=\"dot\"");
  const auto dots = std::distance(std::sregex_iterator(html.begin(), html.end(), dot), {});
  EXPECT_EQ(dots, static_cast<std::ptrdiff_t>(report["energy"]["iterations"].size()));
}

// Each histogram shows every corner or cell once.
TEST_F(Report, HistogramsAreComplete) {
  ASSERT_EQ(mesh().exit_code, 0);
  const std::string html = page();
  const json report = json::parse(bytes_of(fs::path(output_) / "report.json"));
  std::vector<long> sums;
  const std::regex plot_or_bar("<svg class=\"plot\"|</title></rect>");
  const std::regex bar("<title>[^<:]*: ([0-9]+)</title></rect>");
  for (std::size_t at = html.find("<svg class=\"plot\""); at != std::string::npos;
       at = html.find("<svg class=\"plot\"", at + 1)) {
    const std::string svg = html.substr(at, html.find("</svg>", at) - at);
    long sum = 0;
    for (auto b = std::sregex_iterator(svg.begin(), svg.end(), bar); b != std::sregex_iterator();
         ++b) {
      sum += std::stol((*b)[1]);
    }
    sums.push_back(sum);
  }
  const long quads = report["quads"]["count"];
  const long hexes = report["wall"]["hexes"];
  EXPECT_EQ(sums, (std::vector<long>{4 * quads, 4 * quads, hexes, 0}));
}

TEST_F(Report, WarningsComeFirst) {
  ASSERT_EQ(mesh({"--thickness", "3"}).exit_code, 0);
  const std::string html = page();
  const json report = json::parse(bytes_of(fs::path(output_) / "report.json"));
  ASSERT_FALSE(report["warnings"].empty());
  const std::size_t body = html.find("<body>");
  const std::size_t warning = html.find("<div class=\"warnings\">");
  ASSERT_NE(warning, std::string::npos);
  EXPECT_EQ(html.find("<section", body), html.find("<section", warning));
  const std::string words = report["warnings"][0].get<std::string>().substr(0, 20);
  EXPECT_NE(html.find(words, warning), std::string::npos) << words;
}

TEST_F(Report, NeedsNothingElse) {
  ASSERT_EQ(mesh().exit_code, 0);
  const std::string html = page();
  const std::string page_without_script = html.substr(0, html.find("<script>"));
  for (const char* link : {"src=\"http", "href=\"http", "src=\"/", "url(", "@import"}) {
    EXPECT_EQ(page_without_script.find(link), std::string::npos) << link;
  }
}

TEST_F(Report, NamesCannotBreakIt) {
  const std::string file = (folder_ / "x<y>&.stl").string();
  write_surface(file, bifurcation_shape());
  surface_ = file;
  ASSERT_EQ(mesh().exit_code, 0);
  EXPECT_EQ(page().find("x<y>"), std::string::npos);
  EXPECT_NE(page().find("<h1>x&lt;y&gt;&amp;.stl"), std::string::npos);
}

TEST_F(Report, IsLeftOutOnRequest) {
  ASSERT_EQ(mesh({"--no-report"}).exit_code, 0);
  EXPECT_FALSE(fs::exists(fs::path(output_) / "report.html"));
  EXPECT_TRUE(fs::exists(fs::path(output_) / "report.json"));
  expect_failure(3, {"report.html", "--no-report"}, {"view", output_});
}

/// Different colours in a picture, and the share of its pixels that is not white.
struct Look {
  std::size_t colours;
  double drawn;
  std::array<int, 3> size;
};

Look look_at(const fs::path& png) {
  const vtkNew<vtkPNGReader> reader;
  reader->SetFileName(png.c_str());
  reader->Update();
  vtkImageData* image = reader->GetOutput();
  Look look{0, 0.0, {}};
  image->GetDimensions(look.size.data());
  std::set<std::array<unsigned char, 3>> colours;
  const auto* pixel = static_cast<const unsigned char*>(image->GetScalarPointer());
  const auto count = static_cast<std::size_t>(image->GetNumberOfPoints());
  const auto step = static_cast<std::size_t>(image->GetNumberOfScalarComponents());
  for (std::size_t i = 0; i < count; ++i, pixel += step) {
    const std::array<unsigned char, 3> colour{pixel[0], pixel[1], pixel[2]};
    colours.insert(colour);
    if (colour != std::array<unsigned char, 3>{255, 255, 255}) look.drawn += 1.0;
  }
  look.colours = colours.size();
  look.drawn /= static_cast<double>(count);
  return look;
}

TEST_F(Report, PicturesShowTheVessel) {
  if (!can_draw()) GTEST_SKIP() << "Xvfb is not installed";
  // Without the display of whoever runs the tests.
  const ChildResult result =
      mesh({"--pictures", "--side", "both"}, {"env", "-u", "DISPLAY", "-u", "WAYLAND_DISPLAY"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const std::string html = page();
  std::set<std::string> names;
  for (const auto& entry : fs::directory_iterator(fs::path(output_) / "pictures")) {
    const std::string name = entry.path().stem().string();
    names.insert(name);
    const Look look = look_at(entry.path());
    EXPECT_EQ(look.size[0], 1400) << name;
    EXPECT_GT(look.drawn, 0.15) << name;  // the vessel fills the picture
    EXPECT_GT(look.colours, 100U) << name;
    EXPECT_NE(html.find("<img alt=\"" + name + "\" src=\"data:image/png;base64,iVBOR"),
              std::string::npos)
        << name;
  }
  EXPECT_EQ(names, (std::set<std::string>{"input", "checkerboard_before", "checkerboard_after",
                                          "quads", "cut", "scaled_jacobian", "thickness_ratio",
                                          "inner_thickness_ratio"}));
  EXPECT_FALSE(fs::exists(fs::path(output_) / ".pictures"));
}

TEST_F(Report, SaysWhyThereAreNoPictures) {
  const ChildResult result = mesh({"--pictures"}, {"env", "-u", "DISPLAY", "-u", "WAYLAND_DISPLAY",
                                                   "PATH=" + folder_.path().string()});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_NE(result.out.find("There are no pictures: they need a display, or Xvfb"),
            std::string::npos)
      << result.out;
  EXPECT_NE(page().find("There are no pictures"), std::string::npos);
  EXPECT_FALSE(fs::exists(fs::path(output_) / "pictures"));
}

TEST_F(Report, ViewSaysWhereItIsWithoutADisplay) {
  ASSERT_EQ(mesh().exit_code, 0);
  const ChildResult result = run_child(
      {"env", "-u", "DISPLAY", "-u", "WAYLAND_DISPLAY", HEXWALL_PROGRAM, "view", output_});
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_EQ(result.out, output_ + "/report.html\n");
  EXPECT_NE(result.err.find("No browser"), std::string::npos) << result.err;
}

// A browser of ours takes the place of the user's.
TEST_F(Report, ViewOpensTheBrowser) {
  ASSERT_EQ(mesh().exit_code, 0);
  const std::string opened = (folder_ / "opened").string();
  const std::string browser = text_file("xdg-open", "#!/bin/sh\necho \"$1\" > " + opened + "\n");
  fs::permissions(browser, fs::perms::owner_all);
  const ChildResult result =
      run_child({"env", "DISPLAY=:0", "PATH=" + folder_.path().string() + ":/usr/bin:/bin",
                 HEXWALL_PROGRAM, "view", output_});
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_EQ(bytes_of(opened), output_ + "/report.html\n");
  EXPECT_NE(result.out.find("is open in the browser"), std::string::npos) << result.out;
}

}  // namespace
}  // namespace hexwall::test
