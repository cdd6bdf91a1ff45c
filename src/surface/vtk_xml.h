#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace hexwall {

/// An element of an XML file, as far as VTK uses XML: no namespaces, no mixed content.
struct XmlElement {
  std::string_view name;
  std::vector<std::pair<std::string_view, std::string>> attributes = {};
  std::string_view text = {};  ///< behind its opening tag, up to the next one
  std::vector<XmlElement> children = {};

  /// The value of an attribute, or `otherwise`.
  std::string attribute(std::string_view key, const std::string& otherwise = {}) const;

  /// The first child of this name, or null.
  const XmlElement* child(std::string_view child_name) const;
};

/// A file of VTK's XML formats.
struct VtkXmlFile {
  XmlElement root;
  std::string_view appended = {};  ///< what follows the '_' of AppendedData, to the end of the file
  bool is_appended_base64 = false;
};

/// Parses all but the numbers. `content` has to outlive the result.
/// \throws ReadError if the file is not of this format or truncated.
VtkXmlFile parse_vtk_xml(std::string_view content);

/// The numbers of a DataArray, in text, base64, raw or compressed. It reads the first `count` ones,
/// whatever the file says of its sizes; if there are fewer, it never takes more memory than some
/// 10,000 times the file. \throws ReadError if there are fewer, the type is none of numbers, or the
/// data is damaged.
std::vector<double> numbers_of(const VtkXmlFile& file, const XmlElement& array, std::size_t count);

}  // namespace hexwall
