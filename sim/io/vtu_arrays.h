#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include <pugixml.hpp>

#include "sim/io/file.h"

namespace lagomorph::sim::io {

/// The XML of a VTK file, and the numbers of its DataArrays, whichever way they are held: as text, as base64
/// in place or appended, raw, compressed by zlib or not. (docs.vtk.org, "VTK XML Formats")
class VtuArrays {
public:
  /// `file` must outlive it. Throws InputError when the XML is not well-formed or its way of holding data is
  /// not known.
  explicit VtuArrays(const File& file);

  pugi::xml_node root() const { return root_; }
  /// The `count` values of a DataArray; throw InputError when it has more, fewer or others.
  std::vector<double> numbers(pugi::xml_node array, std::uint64_t count);
  std::vector<std::int64_t> integers(pugi::xml_node array, std::uint64_t count);
  /// An attribute that counts things.
  std::uint64_t count(pugi::xml_node node, const char* attribute);
  /// Fails at the line of a node.
  [[noreturn]] void fail(pugi::xml_node, const std::string& message) const;

private:
  void find_appended_data();
  void read_header();
  std::string place(std::ptrdiff_t offset) const;
  std::string_view text_of(pugi::xml_node array) const;
  std::string decode(pugi::xml_node array, std::uint64_t size);
  template <typename Value, typename FromText, typename FromBinary>
  std::vector<Value> values(pugi::xml_node array, std::uint64_t count, FromText from_text,
                            FromBinary from_binary);

  const File& file_;
  pugi::xml_document document_;
  pugi::xml_node root_;
  std::size_t xml_size_ = 0;   // what of the file is XML: appended data may be anything
  std::string_view appended_;  // after its underscore
  bool appended_raw_ = false;
  bool swap_ = false;            // big-endian
  std::size_t header_size_ = 4;  // of the numbers before an array: UInt32 or UInt64
  bool compressed_ = false;
};

}  // namespace lagomorph::sim::io
