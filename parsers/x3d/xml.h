// XML by pugixml, in two ways: as a tree of views into the text, and a tag at a time. Entities are neither declared nor
// fetched, and a document type is passed over.
#pragma once
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/diagnostics.h"

namespace wrlkit {

// ---- a tree --------------------------------------------------------------------------------------------------------

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

  struct Fault {
    std::string what;
    std::size_t at;  // in the text
    bool lost;       // something that stands there; otherwise all of it was read
  };
  std::vector<Fault> repaired;  // faults behind which reading went on
  std::string fault;            // that at which it ended; empty: nowhere
  std::size_t fault_at = 0;     // and where. Nodes that begin before are there.

  std::span<const XmlAttribute> attributes_of(const XmlNode& n) const {
    return std::span(attributes).subspan(n.first_attribute, n.n_attributes);
  }
};

/// Reads UTF-8 or any other encoding in which ASCII is ASCII. Nothing is converted, so that each value lies at its
/// place in the file: what entities mean and in which encoding the text is, the reader of the values knows. Up to 16
/// faults inside of tags are repaired: a blank that is missing between two attributes, an attribute without quotes,
/// which is dropped, and a
/// '<' that begins no tag. The views are good as long as `text`. O(text) for each of them; no recursion.
XmlTree read_xml(std::string_view text);

// ---- a tag at a time -----------------------------------------------------------------------------------------------
// For files that are long lists. pugixml would hold every element of a file and end at the first fault, so tags are cut
// out of the text first: a fault costs one tag, and memory is one tag's. Comments, processing instructions and CDATA
// are passed over.

struct XmlTag {
  enum class Kind : std::uint8_t { end, open, close, empty };  // end: of the text
  struct Attribute {
    std::string_view name, value;  // references resolved
    Span where;                    // of the value
  };

  Kind kind = Kind::end;
  bool sound = true;  // false: a fault in it was reported; what could be read of it is here
  std::string_view name;
  std::span<const Attribute> attributes;
  Span where;

  const Attribute* find(std::string_view attribute) const;
};

class XmlReader {
 public:
  /// A UTF-8 text whose first byte is at `base` in the sources of `diag`. The text must stay.
  XmlReader(std::string_view text, std::uint32_t base, Diagnostics& diag);
  ~XmlReader();

  /// The next tag, good until the next call. Text between tags is no tag; it is reported where it is not blank. O(its
  /// length).
  const XmlTag& next();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// Name of the first element of a text; empty when it does not begin like XML.
std::string_view first_element(std::string_view text);

}  // namespace wrlkit
