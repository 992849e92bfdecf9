// An XML text as a tree of views into it. Nothing is converted, so that each value lies at its place in the file: what
// entities mean and in which encoding the text is, the reader of the values knows.
#pragma once
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace wrlkit::x3d {

struct XmlAttribute {
  std::string_view name, value;  // as in the file
};

struct XmlNode {
  enum class Kind : std::uint8_t { element, text, comment };
  static constexpr std::uint32_t none = 0xffffffffu;

  Kind kind = Kind::element;
  bool cdata = false;        // of a text: entities mean nothing in it
  std::string_view name;     // of an element
  std::string_view content;  // of a text or comment
  std::uint32_t first_attribute = 0, n_attributes = 0;
  std::uint32_t first_child = none, next = none;
};

struct XmlTree {
  std::vector<XmlNode> nodes;  // in the order of the file; the first is the document itself
  std::vector<XmlAttribute> attributes;
  std::string fault;           // what is wrong with the text; empty: nothing
  std::size_t fault_at = 0;    // and where. Nodes that begin before are there.

  std::span<const XmlAttribute> attributes_of(const XmlNode& n) const {
    return std::span(attributes).subspan(n.first_attribute, n.n_attributes);
  }
};

/// Reads UTF-8 or any other encoding in which ASCII is ASCII. A document type is passed over: entities are neither
/// declared nor fetched. The views are good as long as `text`. O(text); no recursion.
XmlTree read_xml(std::string_view text);

}  // namespace wrlkit::x3d
