#pragma once

#include <string>

#include <vtkLookupTable.h>
#include <vtkSmartPointer.h>

#include "options.h"

class vtkPolyDataMapper;
class vtkRenderer;

namespace hexwall {

/// The colours of an array's values; `whole_numbers`: one colour for each whole number.
struct Colours {
  vtkSmartPointer<vtkLookupTable> table;
  bool whole_numbers;
  std::vector<std::string> names = {};  ///< of the whole numbers, if they have any
};

/// Colours the mapper's surface by the array of the options. Whole numbers that are names, such as
/// zones, have these if the data has a field of texts for them: `zone_names`.
/// \throws UsageError if there is no such array.
Colours colour_by(const PictureOptions& options, vtkPolyDataMapper* mapper);

/// Shows what the colours mean: a bar with values, or names on their colours.
void add_legend(const Colours& colours, const std::string& title, int font_size,
                vtkRenderer* renderer);

}  // namespace hexwall
