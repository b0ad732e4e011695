#include "sim/io/vtu_arrays.h"

#include <algorithm>
#include <array>
#include <memory>

#include <libdeflate.h>

#include "sim/error.h"
#include "sim/io/base64.h"
#include "sim/io/number_type.h"
#include "sim/io/scanner.h"

namespace lagomorph::sim::io {
namespace {

struct VtuType {
  std::string_view name;
  NumberType type;
};
constexpr std::array<VtuType, 10> kVtuTypes = {{{"Int8", NumberType::kInt8},
                                                {"UInt8", NumberType::kUInt8},
                                                {"Int16", NumberType::kInt16},
                                                {"UInt16", NumberType::kUInt16},
                                                {"Int32", NumberType::kInt32},
                                                {"UInt32", NumberType::kUInt32},
                                                {"Int64", NumberType::kInt64},
                                                {"UInt64", NumberType::kUInt64},
                                                {"Float32", NumberType::kFloat32},
                                                {"Float64", NumberType::kFloat64}}};

/// Bytes that are taken one part after the other, raw or out of base64.
class Source {
public:
  Source(std::string_view data, bool raw) : data_(data), raw_(raw), base64_(data) {}
  /// An upper bound of what is left, for a size that is checked before it is allocated.
  bool may_have(std::uint64_t size) const { return size <= data_.size(); }
  bool read(std::uint64_t size, std::string& bytes) {
    if (!may_have(size)) return false;
    bytes.reserve(bytes.size() + size);
    if (!raw_) return base64_.read(size, bytes);
    bytes += data_.substr(0, size);
    data_.remove_prefix(size);
    return true;
  }

private:
  std::string_view data_;
  bool raw_;
  Base64Reader base64_;
};

/// Deflate does not compress further than this.
constexpr std::uint64_t kLargestRatio = 1040;

}  // namespace

VtuArrays::VtuArrays(const File& file) : file_(file) {
  find_appended_data();
  std::string xml = file.bytes.substr(0, xml_size_);
  if (xml_size_ < file.bytes.size()) xml += "</VTKFile>";
  const pugi::xml_parse_result result =
      document_.load_buffer(xml.data(), xml.size(), pugi::parse_minimal, pugi::encoding_utf8);
  if (!result) throw InputError(place(result.offset) + "the XML is not well-formed: " + result.description());
  root_ = document_.child("VTKFile");
  if (!root_) throw InputError(place(0) + "no element VTKFile");
  read_header();
}

void VtuArrays::find_appended_data() {
  xml_size_ = std::min(file_.bytes.size(), file_.bytes.find("<AppendedData"));
  if (xml_size_ == file_.bytes.size()) return;
  const std::string_view rest = std::string_view(file_.bytes).substr(xml_size_);
  const std::size_t tag_end = rest.find('>');
  const std::size_t underscore = rest.find('_', tag_end);
  if (tag_end == std::string_view::npos || underscore == std::string_view::npos) {
    throw InputError(place(static_cast<std::ptrdiff_t>(xml_size_)) +
                     "AppendedData has no data; an underscore begins them");
  }
  const std::string_view tag = rest.substr(0, tag_end);
  appended_raw_ =
      tag.find("\"raw\"") != std::string_view::npos || tag.find("'raw'") != std::string_view::npos;
  appended_ = rest.substr(underscore + 1);
}

void VtuArrays::read_header() {
  const std::string_view byte_order = root_.attribute("byte_order").value();
  if (!byte_order.empty() && byte_order != "LittleEndian" && byte_order != "BigEndian") {
    fail(root_, "byte_order is " + in_quotes(byte_order) + "; it must be LittleEndian or BigEndian");
  }
  swap_ = byte_order == "BigEndian";
  const std::string_view header_type = root_.attribute("header_type").value();
  if (!header_type.empty() && header_type != "UInt32" && header_type != "UInt64") {
    fail(root_, "header_type is " + in_quotes(header_type) + "; it must be UInt32 or UInt64");
  }
  header_size_ = header_type == "UInt64" ? 8 : 4;
  const std::string_view compressor = root_.attribute("compressor").value();
  if (!compressor.empty() && compressor != "vtkZLibDataCompressor") {
    fail(root_, "compressor is " + in_quotes(compressor) + "; vtkZLibDataCompressor or none can be read");
  }
  compressed_ = !compressor.empty();
}

std::string VtuArrays::place(std::ptrdiff_t offset) const {
  if (offset < 0) return file_.path + ": ";
  const auto end = file_.bytes.begin() + std::min(offset, static_cast<std::ptrdiff_t>(file_.bytes.size()));
  return file_.path + ":" + std::to_string(1 + std::count(file_.bytes.begin(), end, '\n')) + ": ";
}

void VtuArrays::fail(pugi::xml_node node, const std::string& message) const {
  throw InputError(place(node.offset_debug()) + message);
}

std::uint64_t VtuArrays::count(pugi::xml_node node, const char* attribute) {
  const File text{file_.path, node.attribute(attribute).value()};
  Scanner scanner(text);
  const std::string_view word = scanner.peek();
  const bool digits = !word.empty() && word.size() < 10 &&
                      std::all_of(word.begin(), word.end(), [](char c) { return c >= '0' && c <= '9'; });
  if (!digits)
    fail(node, std::string(attribute) + " is " + in_quotes(text.bytes) +
                   "; it must be a number of less than ten digits");
  return static_cast<std::uint64_t>(scanner.integer(attribute));
}

std::string_view VtuArrays::text_of(pugi::xml_node array) const {
  for (const pugi::xml_node child : array.children()) {
    if (child.type() != pugi::node_pcdata) continue;
    // As it stands in the file, so that errors can tell lines.
    const auto begin = static_cast<std::size_t>(child.offset_debug());
    const std::size_t end = std::min(xml_size_, file_.bytes.find('<', begin));
    return std::string_view(file_.bytes).substr(begin, end - begin);
  }
  return std::string_view(file_.bytes).substr(xml_size_, 0);
}

std::string VtuArrays::decode(pugi::xml_node array, std::uint64_t size) {
  const bool is_appended = std::string_view(array.attribute("format").value()) == "appended";
  std::string_view data = is_appended ? appended_ : text_of(array);
  if (is_appended) {
    const std::uint64_t offset = array.attribute("offset").as_ullong(appended_.size());
    if (offset >= appended_.size()) {
      fail(array,
           "the offset " + in_quotes(array.attribute("offset").value()) + " is outside of the appended data");
    }
    data.remove_prefix(offset);
  }
  Source source(data, is_appended && appended_raw_);
  const std::string name = "array " + in_quotes(array.attribute("Name").value());
  const auto cut_short = [&] { fail(array, name + " is cut short or no base64"); };
  const auto read_size = [&] {
    std::string bytes;
    if (!source.read(header_size_, bytes)) cut_short();
    Scanner scanner(bytes, file_.path);
    scanner.set_binary(swap_);
    return header_size_ == 8 ? scanner.binary<std::uint64_t>("a size")
                             : scanner.binary<std::uint32_t>("a size");
  };
  const auto check_size = [&](std::uint64_t found) {
    if (found != size)
      fail(array, name + " has " + std::to_string(found) + " bytes; it must have " + std::to_string(size));
  };
  std::string result;
  if (!compressed_) {
    check_size(read_size());
    if (!source.read(size, result)) cut_short();
    return result;
  }
  // Number of blocks, size of each but the last, size of the last if it is not full; then their compressed
  // sizes.
  const std::uint64_t blocks = read_size(), block_size = read_size(), last_size = read_size();
  if (!source.may_have(blocks)) cut_short();
  std::vector<std::uint64_t> compressed_sizes(blocks);
  for (std::uint64_t& compressed : compressed_sizes) compressed = read_size();
  const std::unique_ptr<libdeflate_decompressor, void (*)(libdeflate_decompressor*)> decompressor(
      libdeflate_alloc_decompressor(), &libdeflate_free_decompressor);
  for (std::uint64_t b = 0; b < blocks; ++b) {
    const std::uint64_t expected = b + 1 == blocks && last_size > 0 ? last_size : block_size;
    std::string compressed;
    if (!source.read(compressed_sizes[b], compressed)) cut_short();
    if (expected > kLargestRatio * (compressed.size() + 64)) cut_short();
    const std::size_t begin = result.size();
    result.resize(begin + expected);
    if (libdeflate_zlib_decompress(decompressor.get(), compressed.data(), compressed.size(),
                                   result.data() + begin, expected, nullptr) != LIBDEFLATE_SUCCESS) {
      fail(array, name + ": block " + std::to_string(b) + " of its compressed data cannot be decompressed");
    }
  }
  check_size(result.size());
  return result;
}

template <typename Value, typename FromText, typename FromBinary>
std::vector<Value> VtuArrays::values(pugi::xml_node array, std::uint64_t count, FromText from_text,
                                     FromBinary from_binary) {
  const std::string name = "array " + in_quotes(array.attribute("Name").value());
  const std::string_view type_name = array.attribute("type").value();
  const auto* type =
      std::find_if(kVtuTypes.begin(), kVtuTypes.end(), [&](const VtuType& t) { return t.name == type_name; });
  if (type == kVtuTypes.end())
    fail(array, name + " is of type " + in_quotes(type_name) + ", which is unknown");
  const std::string_view format = array.attribute("format").value();
  std::vector<Value> result;
  if (format == "ascii") {
    const std::string_view text = text_of(array);
    if (count > (text.size() + 1) / 2) {
      fail(array, name + " must have " + std::to_string(count) + " values, more than its text can hold");
    }
    const auto begin = static_cast<std::size_t>(text.data() - file_.bytes.data());
    Scanner scanner(std::string_view(file_.bytes).substr(0, begin + text.size()), file_.path);
    scanner.seek(begin);
    result.resize(count);
    for (Value& value : result) value = from_text(scanner);
    if (!scanner.at_end())
      fail(array, name + " has more values than the " + std::to_string(count) + " that it must have");
  } else if (format == "binary" || format == "appended") {
    const std::string bytes = decode(array, count * size_of(type->type));
    const std::string origin = place(array.offset_debug()) + name;
    Scanner scanner(bytes, origin);
    scanner.set_binary(swap_);
    result.resize(count);
    for (Value& value : result) value = from_binary(scanner, type->type);
  } else {
    fail(array, name + " has the format " + in_quotes(format) + "; ascii, binary and appended are known");
  }
  return result;
}

std::vector<double> VtuArrays::numbers(pugi::xml_node array, std::uint64_t count) {
  return values<double>(
      array, count, [](Scanner& scanner) { return scanner.number("a value"); },
      [](Scanner& scanner, NumberType type) { return binary_number(scanner, type, "a value"); });
}

std::vector<std::int64_t> VtuArrays::integers(pugi::xml_node array, std::uint64_t count) {
  return values<std::int64_t>(
      array, count, [](Scanner& scanner) { return scanner.integer("a value"); },
      [](Scanner& scanner, NumberType type) { return binary_integer(scanner, type, "a value"); });
}

}  // namespace lagomorph::sim::io
