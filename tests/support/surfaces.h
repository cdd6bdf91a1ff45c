#pragma once

#include <optional>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "surface/triangle_surface.h"

namespace hexwall::test {

/// Every surface from which a wall must come out: the generated shapes, the aneurysm of Debian's
/// gmsh-doc ("aneurysm"), and the shared files that pass `check_surface`.
std::vector<std::string> meshable_surfaces();

/// A surface by its name in `meshable_surfaces`, or any shared file. Nothing if its file is not on
/// this machine: tests then skip.
std::optional<TriangleSurface> load_surface(const std::string& name);

/// Where the file with a surface lies, made in `folder` if it has to be.
std::optional<std::string> surface_file(const std::string& name, const std::string& folder);

/// The name of a parametrised test whose parameter is the name of a surface.
std::string test_name(const testing::TestParamInfo<std::string>& info);

}  // namespace hexwall::test
