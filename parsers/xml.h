// XML, a tag at a time, for files that are long lists. pugixml is a DOM parser, which would hold every element of a file and end
// at the first fault. So tags are cut out of the text here, and pugixml reads each by itself: a fault costs one tag, and
// memory is one tag's. Comments, processing instructions, CDATA and document types are passed over; entities beyond those
// of XML itself are not expanded.
#pragma once
#include <memory>
#include <span>
#include <string_view>

#include "scenegraph/diagnostics.h"

namespace wrlkit {

struct XmlAttribute {
  std::string_view name, value;  // references resolved
  Span where;                    // of the value
};

struct XmlTag {
  enum class Kind : std::uint8_t { end, open, close, empty };  // end: of the text

  Kind kind = Kind::end;
  bool sound = true;  // false: a fault in it was reported; what could be read of it is here
  std::string_view name;
  std::span<const XmlAttribute> attributes;
  Span where;

  const XmlAttribute* find(std::string_view attribute) const;
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
