#include "surface/vtk_xml.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>

#include <fmt/format.h>
#include <vtkDataCompressor.h>
#include <vtkLZ4DataCompressor.h>
#include <vtkLZMADataCompressor.h>
#include <vtkSmartPointer.h>
#include <vtkZLibDataCompressor.h>

#include "core/errors.h"
#include "surface/number_source.h"
#include "surface/vtk_messages.h"

namespace hexwall {
namespace {

constexpr std::string_view blanks = " \t\r\n";
constexpr std::size_t deepest = 100;
// No compressor makes real data smaller than that: what announces more is damaged.
constexpr std::size_t greatest_compression = 10000;

[[noreturn]] void fail(const std::string& what) {
  throw ReadError("the file is no proper XML: " + what);
}

// --- elements -----------------------------------------------------------------------------------

class Parser {
 public:
  explicit Parser(std::string_view content) : rest_(content) {}

  VtkXmlFile parse() {
    VtkXmlFile file;
    std::vector<XmlElement> open;
    while (true) {
      const std::string_view text = until("<");
      if (!open.empty() && open.back().children.empty()) open.back().text = text;
      if (skip_comment()) continue;
      const std::string_view tag = inside_tag();
      if (tag.starts_with('/')) {
        if (open.empty() || name_of(tag.substr(1)) != open.back().name) fail("tags do not match");
      } else {
        open.push_back(element_of(tag));
        if (open.size() > deepest) fail("elements are too deep in each other");
        if (open.back().name == "AppendedData") {
          find_appended(open.back(), file);
          file.root = std::move(open.front());
          return file;
        }
        if (!tag.ends_with('/')) continue;
      }
      if (close(open, file)) return file;
    }
  }

 private:
  std::string_view until(std::string_view end) {
    const std::size_t at = rest_.find(end);
    if (at == std::string_view::npos) fail(fmt::format("it ends before a '{}'", end));
    const std::string_view taken = rest_.substr(0, at);
    rest_.remove_prefix(at + end.size());
    return taken;
  }

  // Comments and what only concerns XML itself.
  bool skip_comment() {
    if (rest_.starts_with("!--")) {
      until("-->");
    } else if (rest_.starts_with('?') || rest_.starts_with('!')) {
      until(">");
    } else {
      return false;
    }
    return true;
  }

  // A '>' between quotes ends no tag.
  std::string_view inside_tag() {
    std::optional<char> quote;
    for (std::size_t i = 0; i < rest_.size(); ++i) {
      const char c = rest_[i];
      if (quote) {
        if (c == *quote) quote.reset();
      } else if (c == '"' || c == '\'') {
        quote = c;
      } else if (c == '>') {
        const std::string_view tag = rest_.substr(0, i);
        rest_.remove_prefix(i + 1);
        return tag;
      }
    }
    fail("it ends within a tag");
  }

  static std::string_view name_of(std::string_view tag) {
    return tag.substr(0, tag.find_first_of(" \t\r\n/"));
  }

  static XmlElement element_of(std::string_view tag) {
    XmlElement element{name_of(tag)};
    if (element.name.empty()) fail("a tag without a name");
    std::string_view rest = tag.substr(element.name.size());
    while (true) {
      rest.remove_prefix(std::min(rest.find_first_not_of(" \t\r\n/"), rest.size()));
      if (rest.empty()) return element;
      const std::size_t equals = rest.find('=');
      const std::size_t begin = rest.find_first_of("\"'");
      if (begin == std::string_view::npos || equals > begin) fail("an attribute without a value");
      const std::size_t end = rest.find(rest[begin], begin + 1);
      if (end == std::string_view::npos) fail("an attribute without an end");
      const std::string_view key = rest.substr(0, rest.find_first_of(" \t\r\n="));
      element.attributes.emplace_back(key, unescaped(rest.substr(begin + 1, end - begin - 1)));
      rest.remove_prefix(end + 1);
    }
  }

  static std::string unescaped(std::string_view value) {
    constexpr std::array<std::pair<std::string_view, char>, 5> entities{
        {{"&lt;", '<'}, {"&gt;", '>'}, {"&amp;", '&'}, {"&quot;", '"'}, {"&apos;", '\''}}};
    std::string result;
    while (!value.empty()) {
      const auto* entity = std::find_if(entities.begin(), entities.end(),
                                        [&](const auto& e) { return value.starts_with(e.first); });
      result += entity != entities.end() ? entity->second : value[0];
      value.remove_prefix(entity != entities.end() ? entity->first.size() : 1);
    }
    return result;
  }

  void find_appended(const XmlElement& element, VtkXmlFile& file) {
    until("_");
    file.appended = rest_;
    file.is_appended_base64 = element.attribute("encoding", "base64") == "base64";
  }

  // Moves the innermost element into the one around it. True if it was the outermost one.
  static bool close(std::vector<XmlElement>& open, VtkXmlFile& file) {
    XmlElement done = std::move(open.back());
    open.pop_back();
    if (open.empty()) {
      file.root = std::move(done);
      return true;
    }
    open.back().children.push_back(std::move(done));
    return false;
  }

  std::string_view rest_;
};

// --- numbers ------------------------------------------------------------------------------------

/// Bytes in base64, which may consist of several streams one after the other, or as they are.
class ByteStream {
 public:
  ByteStream(std::string_view text, bool is_base64) : rest_(text), is_base64_(is_base64) {}

  std::string take(std::size_t count) {
    // No more bytes can come out than characters are there: do not even try.
    if (count > rest_.size() + decoded_.size()) throw ReadError("the file is truncated");
    if (!is_base64_) {
      std::string bytes(rest_.substr(0, count));
      rest_.remove_prefix(count);
      return bytes;
    }
    while (decoded_.size() < count) decode_group();
    std::string bytes = decoded_.substr(0, count);
    decoded_.erase(0, count);
    return bytes;
  }

 private:
  void decode_group() {
    std::uint32_t bits = 0;
    int padding = 0;
    for (int i = 0; i < 4; ++i) {
      rest_.remove_prefix(std::min(rest_.find_first_not_of(blanks), rest_.size()));
      if (rest_.empty()) throw ReadError("the file is truncated");
      padding += rest_[0] == '=' ? 1 : 0;
      bits = (bits << 6) | (rest_[0] == '=' ? 0U : value_of(rest_[0]));
      rest_.remove_prefix(1);
    }
    for (int byte = 0; byte < 3 - std::min(padding, 3); ++byte) {
      decoded_ += static_cast<char>((bits >> (16 - 8 * byte)) & 255U);
    }
  }

  static std::uint32_t value_of(char c) {
    constexpr std::string_view digits =
        "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    const std::size_t value = digits.find(c);
    if (value == std::string_view::npos) throw ReadError("the file has damaged base64 data");
    return static_cast<std::uint32_t>(value);
  }

  std::string_view rest_;
  bool is_base64_;
  std::string decoded_;
};

struct Type {
  std::string_view name;
  Scalar scalar;
  std::size_t size;
};

constexpr std::array<Type, 10> types{{{"Int8", Scalar::int8, 1},
                                      {"UInt8", Scalar::uint8, 1},
                                      {"Int16", Scalar::int16, 2},
                                      {"UInt16", Scalar::uint16, 2},
                                      {"Int32", Scalar::int32, 4},
                                      {"UInt32", Scalar::uint32, 4},
                                      {"Int64", Scalar::int64, 8},
                                      {"UInt64", Scalar::uint64, 8},
                                      {"Float32", Scalar::float32, 4},
                                      {"Float64", Scalar::float64, 8}}};

const Type& type_of(const XmlElement& array) {
  const std::string name = array.attribute("type");
  for (const Type& type : types) {
    if (type.name == name) return type;
  }
  throw ReadError(fmt::format("numbers of the unknown type '{}'", name));
}

Encoding encoding_of(const VtkXmlFile& file) {
  const bool is_big = file.root.attribute("byte_order", "LittleEndian") == "BigEndian";
  return is_big ? Encoding::big_endian : Encoding::little_endian;
}

/// Sizes before the data, in the file's own kind of integers.
std::vector<std::size_t> take_sizes(ByteStream& stream, const VtkXmlFile& file, std::size_t count) {
  const bool is_long = file.root.attribute("header_type", "UInt32") == "UInt64";
  const std::string bytes = stream.take(count * (is_long ? 8 : 4));
  NumberSource source(bytes);
  std::vector<std::size_t> sizes;
  for (std::size_t i = 0; i < count; ++i) {
    const double size = source.number(is_long ? Scalar::uint64 : Scalar::uint32, encoding_of(file));
    if (size > 1e15) throw ReadError("the file is damaged: a block of data is too large");
    sizes.push_back(static_cast<std::size_t>(size));
  }
  return sizes;
}

vtkSmartPointer<vtkDataCompressor> compressor_of(const VtkXmlFile& file) {
  const std::string name = file.root.attribute("compressor");
  if (name.empty()) return nullptr;
  if (name == "vtkZLibDataCompressor") return vtkSmartPointer<vtkZLibDataCompressor>::New();
  if (name == "vtkLZ4DataCompressor") return vtkSmartPointer<vtkLZ4DataCompressor>::New();
  if (name == "vtkLZMADataCompressor") return vtkSmartPointer<vtkLZMADataCompressor>::New();
  throw ReadError(fmt::format("the compressor '{}' is unknown", name));
}

std::string uncompressed(vtkDataCompressor& compressor, const std::string& block,
                         std::size_t size) {
  if (size / greatest_compression > block.size()) {
    throw ReadError("the file is damaged: a block of data is too large");
  }
  std::string result(size, '\0');
  const VtkMessages messages;  // or its complaints go to the console
  const std::size_t got =
      compressor.Uncompress(reinterpret_cast<const unsigned char*>(block.data()), block.size(),
                            reinterpret_cast<unsigned char*>(result.data()), size);
  if (got != size) throw ReadError("the file has damaged compressed data");
  return result;
}

// The number of blocks, the size of each, that of the last one if it is smaller, their sizes when
// compressed, the blocks.
std::string take_compressed(ByteStream& stream, const VtkXmlFile& file, std::size_t size,
                            vtkDataCompressor& compressor) {
  const std::size_t count = take_sizes(stream, file, 1)[0];
  const std::vector<std::size_t> head = take_sizes(stream, file, 2);
  const std::vector<std::size_t> compressed = take_sizes(stream, file, count);
  std::string bytes;
  for (std::size_t i = 0; i < count && bytes.size() < size; ++i) {
    const bool is_short = i + 1 == count && head[1] > 0;
    bytes += uncompressed(compressor, stream.take(compressed[i]), head[is_short ? 1 : 0]);
  }
  if (bytes.size() < size) throw ReadError("the file is truncated");
  return bytes;
}

ByteStream stream_of(const VtkXmlFile& file, const XmlElement& array) {
  if (array.attribute("format") != "appended") return {array.text, true};
  const std::size_t offset = count_of(array.attribute("offset"));
  if (offset > file.appended.size()) throw ReadError("the file is truncated");
  return {file.appended.substr(offset), file.is_appended_base64};
}

std::string bytes_of(const VtkXmlFile& file, const XmlElement& array, std::size_t size) {
  ByteStream stream = stream_of(file, array);
  if (size == 0) return {};
  if (const auto compressor = compressor_of(file)) {
    return take_compressed(stream, file, size, *compressor);
  }
  if (take_sizes(stream, file, 1)[0] < size) throw ReadError("the file is truncated");
  return stream.take(size);
}

}  // namespace

std::string XmlElement::attribute(std::string_view key, const std::string& otherwise) const {
  for (const auto& [name_of, value] : attributes) {
    if (name_of == key) return value;
  }
  return otherwise;
}

const XmlElement* XmlElement::child(std::string_view child_name) const {
  for (const XmlElement& element : children) {
    if (element.name == child_name) return &element;
  }
  return nullptr;
}

VtkXmlFile parse_vtk_xml(std::string_view content) {
  return Parser(content).parse();
}

std::vector<double> numbers_of(const VtkXmlFile& file, const XmlElement& array, std::size_t count) {
  const Type& type = type_of(array);
  const std::string format = array.attribute("format", "ascii");
  const bool is_text = format == "ascii";
  const std::string bytes = is_text ? std::string() : bytes_of(file, array, count * type.size);
  NumberSource source(is_text ? array.text : std::string_view(bytes));
  std::vector<double> numbers;
  while (numbers.size() < count) {
    numbers.push_back(source.number(type.scalar, is_text ? Encoding::text : encoding_of(file)));
  }
  return numbers;
}

}  // namespace hexwall
