// Text inside XML.
#pragma once
#include <string>
#include <string_view>

#include "base/io/sink.h"

namespace wrlkit {

/// Into an attribute between apostrophes: characters that XML can hold (XmlCharacters).
inline void xml_attribute_text(TextOut& out, std::string_view s) {
  for (char c : s) switch (c) {
      case '&':
        out << "&amp;";
        break;
      case '<':
        out << "&lt;";
        break;
      case '>':
        out << "&gt;";
        break;
      case '\'':
        out << "&apos;";
        break;
      case '\n':
        out << "&#10;";
        break;
      case '\r':
        out << "&#13;";
        break;
      case '\t':
        out << "&#9;";
        break;
      default:
        out << c;
    }
}

/// Into text, or an attribute between quotation marks, of XML or HTML. Control characters that XML cannot hold become
/// blanks; those that it can stay, and are blanks to readers of an attribute.
inline std::string xml_text(std::string_view s) {
  std::string out;
  for (char c : s) switch (c) {
      case '&':
        out += "&amp;";
        break;
      case '<':
        out += "&lt;";
        break;
      case '>':
        out += "&gt;";
        break;
      case '"':
        out += "&quot;";
        break;
      default:
        out += static_cast<unsigned char>(c) < ' ' && c != '\t' && c != '\n' && c != '\r' ? ' ' : c;
    }
  return out;
}

}  // namespace wrlkit
