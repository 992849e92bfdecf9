// Field values in attributes of XML (ISO/IEC 19776-1, 5): numbers are those of VRML without brackets, strings are
// plain, lists of strings are quoted inside the quotes of XML.
#pragma once
#include <algorithm>

#include "parsers/vrml/values.h"
#include "parsers/x3d/xml.h"

namespace wrlkit::x3d {

class AttributeValues : protected vrml::Values {
 protected:
  AttributeValues(std::string_view text, std::uint32_t base, Scene& scene, Diagnostics& diag)
      : Values(text, base, scene, diag), text_(text), text_base_(base) {}

  /// A value of any type that holds no nodes; `fallback` gives what a value that is too short lacks. False: there is
  /// none, which was reported.
  bool value(FieldType, std::uint16_t slot, std::string_view field, const Value& fallback, std::string_view attribute,
             Value& out);

  Span span_of(std::string_view part) const {
    return {text_base_ + static_cast<std::uint32_t>(part.data() - text_.data()),
            std::max<std::uint32_t>(1, static_cast<std::uint32_t>(part.size()))};
  }
  /// What an attribute or text says in UTF-8: entities resolved, line ends made blanks as XML asks for.
  std::string_view plain(std::string_view raw, bool attribute = true);
  /// What stands between <![CDATA[ and ]]>.
  std::string_view verbatim_text(std::string_view raw) { return utf8_of(raw); }

  bool latin1_ = false;  // the text says that it is in ISO 8859-1

 private:
  std::string_view utf8_of(std::string_view raw);
  void entity(std::string_view raw, std::size_t& at, std::string& out);
  bool booleans(FieldType, std::uint16_t slot, std::string_view field, std::string_view attribute, Value& out);
  bool numbers_of(FieldType, std::uint16_t slot, std::string_view field, const Value& fallback,
                  std::string_view attribute, Value& out);
  void strings(std::uint16_t slot, std::string_view attribute, Value& out);
  /// Sets the lexer onto a part of the text, or onto what it says where that differs.
  std::string_view enter(std::string_view attribute, std::string_view says);
  bool at_end(std::string_view type);

  std::string_view text_;
  std::uint32_t text_base_;
};

}  // namespace wrlkit::x3d
