#include "parsers/xml.h"

#include <algorithm>
#include <pugixml.hpp>
#include <string>
#include <vector>

#include "scenegraph/blanks.h"

namespace wrlkit {
namespace {

struct Cut {
  std::string_view text;   // with its brackets, if they are there
  bool complete = false;   // it ends with '>'
};

/// The tag at the beginning of `s`. '<' cannot be in a tag, not even between quotes, so a quote that is never closed ends
/// there.
Cut cut_tag(std::string_view s) {
  char quote = 0;
  for (std::size_t i = 1; i < s.size(); ++i) {
    const char c = s[i];
    if (c == '<') return {s.substr(0, i), false};
    if (quote) quote = c == quote ? 0 : quote;
    else if (c == '"' || c == '\'') quote = c;
    else if (c == '>') return {s.substr(0, i + 1), true};
  }
  return {s, false};
}

/// The declaration at the beginning of `s`, with what it holds between '[' and ']'.
std::string_view cut_doctype(std::string_view s) {
  char quote = 0;
  bool inside = false;
  for (std::size_t i = 2; i < s.size(); ++i) {
    const char c = s[i];
    if (quote) quote = c == quote ? 0 : quote;
    else if (c == '"' || c == '\'') quote = c;
    else if (c == '[' || c == ']') inside = c == '[';
    else if (c == '>' && !inside) return s.substr(0, i + 1);
  }
  return s;
}

struct Skipped {
  std::string_view begin, end;
};
constexpr Skipped skipped[] = {{"<!--", "-->"}, {"<![CDATA[", "]]>"}, {"<?", "?>"}};

}  // namespace

const XmlAttribute* XmlTag::find(std::string_view attribute) const {
  auto found = std::ranges::find(attributes, attribute, &XmlAttribute::name);
  return found == attributes.end() ? nullptr : &*found;
}

struct XmlReader::State {
  std::string_view text;
  std::uint32_t base;
  Diagnostics& diag;
  std::size_t at = 0;
  XmlTag tag;
  std::vector<XmlAttribute> attributes;
  std::string buffer;      // the tag that pugixml reads, and changes in place
  pugi::xml_document document;

  Span span(std::string_view piece) const { return {base + static_cast<std::uint32_t>(piece.data() - text.data()), static_cast<std::uint32_t>(piece.size())}; }
  std::string_view rest() const { return text.substr(at); }

  /// Past text, comments and declarations to the next tag; false at the end.
  bool find_tag() {
    while (at < text.size()) {
      const auto between = rest().substr(0, rest().find('<'));
      if (const auto words = trim(between); !words.empty()) diag.report(Diag::stray_token, span(words), "text between tags");
      at += between.size();
      if (at < text.size() && !skip_declaration()) return true;
    }
    return false;
  }

  bool skip_declaration() {
    const auto s = rest();
    for (const auto& [begin, end] : skipped) {
      if (!s.starts_with(begin)) continue;
      const auto found = s.find(end, begin.size());
      if (found == s.npos) diag.report(Diag::unclosed, span(s.substr(0, begin.size())), begin);
      at = found == s.npos ? text.size() : at + found + end.size();
      return true;
    }
    if (!s.starts_with("<!")) return false;
    const auto doctype = cut_doctype(s);
    diag.report(Diag::xml_doctype, span(doctype.substr(0, 9)));
    at += doctype.size();
    return true;
  }

  void read_tag() {
    const auto [piece, complete] = cut_tag(rest());
    at += piece.size();
    tag.where = span(trim(piece));
    tag.sound = complete;
    if (!complete) diag.report(Diag::xml_syntax, tag.where, "'>' expected");
    auto inner = piece.substr(1, piece.size() - 1 - complete);
    tag.kind = inner.starts_with('/') ? XmlTag::Kind::close : inner.ends_with('/') ? XmlTag::Kind::empty : XmlTag::Kind::open;
    if (tag.kind == XmlTag::Kind::close) inner.remove_prefix(1);
    if (tag.kind == XmlTag::Kind::empty) inner.remove_suffix(1);
    parse(inner);
  }

  /// `inner`: the name and what follows it.
  void parse(std::string_view inner) {
    buffer.assign("<").append(inner).append("/>");
    const auto result = document.load_buffer_inplace(buffer.data(), buffer.size(), pugi::parse_default, pugi::encoding_utf8);
    const auto place = [&](const char* in_buffer, std::size_t length) {
      const auto offset = static_cast<std::size_t>(in_buffer - buffer.data()) - 1;  // '<'
      return span(inner.substr(std::min(offset, inner.size()), length));
    };
    if (!result && tag.sound) {
      tag.sound = false;
      const auto offset = std::clamp<std::size_t>(static_cast<std::size_t>(result.offset), 1, buffer.size());
      diag.report(Diag::xml_syntax, place(buffer.data() + offset, 1), result.description());
    }
    const auto element = document.first_child();
    tag.name = element.name();
    attributes.clear();
    for (const auto& a : element.attributes()) {
      const std::string_view value = a.value();
      attributes.push_back({a.name(), value, value.empty() ? tag.where : place(value.data(), value.size())});
    }
    tag.attributes = attributes;
  }
};

XmlReader::XmlReader(std::string_view text, std::uint32_t base, Diagnostics& diag) : state_(new State{text, base, diag}) {}
XmlReader::~XmlReader() = default;

const XmlTag& XmlReader::next() {
  auto& s = *state_;
  s.tag = {};
  if (s.find_tag()) s.read_tag();
  return s.tag;
}

std::string_view first_element(std::string_view text) {
  constexpr std::string_view blanks = " \t\r\n";
  if (text.starts_with("\xef\xbb\xbf")) text.remove_prefix(3);
  for (;;) {
    text.remove_prefix(std::min(text.find_first_not_of(blanks), text.size()));
    if (!text.starts_with('<')) return {};
    auto s = std::ranges::find_if(skipped, [&](const Skipped& k) { return text.starts_with(k.begin); });
    if (s == std::end(skipped) && !text.starts_with("<!")) break;
    const auto size = s == std::end(skipped) ? cut_doctype(text).size() : std::min(text.find(s->end), text.size());
    text.remove_prefix(std::min(text.size(), s == std::end(skipped) ? size : size + s->end.size()));
  }
  text.remove_prefix(1);
  return text.substr(0, text.find_first_of(" \t\r\n/>"));
}

}  // namespace wrlkit
