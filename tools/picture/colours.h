#pragma once

#include <string>

#include <vtkLookupTable.h>
#include <vtkScalarBarActor.h>
#include <vtkSmartPointer.h>

#include "options.h"

class vtkPolyDataMapper;

namespace hexwall {

/// The colours of an array's values; `whole_numbers`: one colour for each whole number.
struct Colours {
  vtkSmartPointer<vtkLookupTable> table;
  bool whole_numbers;
  bool named;  ///< the whole numbers have texts
};

/// Colours the mapper's surface by the array of the options. Whole numbers that are names, such as
/// zones, have these if the data has a field of texts for them: `zone_names`.
/// \throws UsageError if there is no such array.
Colours colour_by(const PictureOptions& options, vtkPolyDataMapper* mapper);

/// A bar with the colours and their values.
vtkSmartPointer<vtkScalarBarActor> scalar_bar(const Colours& colours, const std::string& title,
                                              int font_size);

}  // namespace hexwall
