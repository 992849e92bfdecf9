// What of a text XML can hold: not every character of Unicode, and even fewer of them in names.
#pragma once
#include <cstddef>
#include <string>
#include <string_view>

namespace wrlkit {

/// Texts with U+FFFD for every character that XML cannot hold (XML 1.0, 2.2: control characters, U+FFFE, U+FFFF, halves
/// of surrogate pairs) and for every byte that is no UTF-8; they are counted.
class XmlCharacters {
 public:
  /// The text itself where nothing has to be replaced; otherwise valid until the next call.
  std::string_view only(std::string_view s);
  std::size_t n_replaced() const { return n_replaced_; }

 private:
  std::string made_;
  std::size_t n_replaced_ = 0;
};

/// Whether XML can hold all of a text.
bool is_xml_text(std::string_view s);

/// A Name of XML without a colon. Of letters beyond ASCII those that every edition of XML 1.0 allows: widespread
/// readers (expat) know the lists of the first ones.
bool is_xml_name(std::string_view s);

}  // namespace wrlkit
