#pragma once

#include <string>
#include <vector>

namespace hexwall {

/// What hexwall-picture is told.
struct PictureOptions {
  std::string input;
  std::string output;
  std::string array;          ///< point or cell array that colours the surface; empty: none
  std::vector<double> range;  ///< values of the first and the last colour; empty: those of the data
  std::string texture;        ///< empty or "checkerboard"
  std::string lines;          ///< poly data file drawn on top as tubes and labels; empty: none
  std::string title;          ///< of the colours; empty: the name of the array
  std::vector<double> view;   ///< direction from the data to the eye; empty: chosen from the data
  std::vector<double> frame;  ///< directions to the right and up; empty: from `view`
  std::vector<double>
      focus;  ///< centre and radius of what fills the picture, no more than everything
  std::vector<double> clip;  ///< point and normal of a plane; cells on the normal's side stay
  double zoom = 1;
  std::string size = "1600x1200";
  bool edges = false;
  bool perspective = false;
};

}  // namespace hexwall
