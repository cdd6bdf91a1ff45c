#include "exporters/foam_file.h"

#include <utility>

#include "exporters/text.h"

namespace hexwall {

std::string foam_header(std::string_view foam_class, std::string_view location,
                        std::string_view object, std::string_view note) {
  Text text(512);
  text << "FoamFile\n{\n    version     2.0;\n    format      ascii;\n    class       "
       << foam_class << ";\n";
  if (!note.empty()) text << "    note        \"" << note << "\";\n";
  text << "    location    \"" << location << "\";\n    object      " << object << ";\n}\n\n";
  return text.take();
}

OutputFile foam_dictionary(std::string_view folder, std::string_view name, std::string_view body) {
  return {std::string(folder) + '/' + std::string(name),
          foam_header("dictionary", folder, name) + std::string(body)};
}

}  // namespace hexwall
