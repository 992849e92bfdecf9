#include "parsers/x3d/xml.h"

#include <algorithm>
#include <cstring>
#include <functional>
#include <pugixml.hpp>

#include "base/text/blanks.h"

namespace wrlkit {
namespace {

/// What is done to a text so that pugixml reads on.
struct Repairs {
  std::vector<std::size_t> blanks;                          // in front of these places, ascending
  std::vector<std::pair<std::size_t, std::size_t>> erased;  // from, to
};

/// What pugixml works in and cuts up: a copy of the text, repaired.
struct Copy {
  std::string bytes;
  const std::vector<std::size_t>& blanks;

  Copy(std::string_view text, const Repairs& r) : blanks(r.blanks) {
    bytes.reserve(text.size() + blanks.size());
    bytes = text;
    for (auto [from, to] : r.erased)
      std::fill(bytes.begin() + static_cast<std::ptrdiff_t>(from), bytes.begin() + static_cast<std::ptrdiff_t>(to),
                ' ');
    for (auto b = blanks.rbegin(); b != blanks.rend(); ++b) bytes.insert(*b, 1, ' ');
  }
  std::size_t in_text(std::size_t at) const {
    std::size_t before = 0;
    while (before < blanks.size() && blanks[before] + before < at) ++before;
    return at - before;
  }
};

class Flattener {
 public:
  Flattener(std::string_view text, const Copy& copy, XmlTree& tree) : text_(text), copy_(copy), tree_(tree) {}

  void run(pugi::xml_node document) {
    tree_.nodes.emplace_back();
    std::vector<std::uint32_t> last{XmlNode::none}, open{0};
    for (pugi::xml_node n = document.first_child(); n;) {
      if (auto id = add(n); id != XmlNode::none) {
        (last.back() == XmlNode::none ? tree_.nodes[open.back()].first_child : tree_.nodes[last.back()].next) = id;
        last.back() = id;
        if (n.first_child()) {
          open.push_back(id);
          last.push_back(XmlNode::none);
          n = n.first_child();
          continue;
        }
      }
      while (!n.next_sibling() && n.parent() != document) {
        n = n.parent();
        open.pop_back();
        last.pop_back();
      }
      n = n.next_sibling();
    }
  }

 private:
  /// What pugixml never read, in a text that is cut off, is a constant of its own.
  std::string_view view(const char* p) const {
    const char* begin = copy_.bytes.data();
    const bool inside = !std::less<>{}(p, begin) && !std::less<>{}(begin + copy_.bytes.size(), p);
    return inside ? text_.substr(copy_.in_text(static_cast<std::size_t>(p - begin)), std::strlen(p))
                  : text_.substr(text_.size());
  }

  std::uint32_t add(pugi::xml_node n) {
    XmlNode out;
    switch (n.type()) {
      case pugi::node_element:
        out.name = view(n.name());
        out.first_attribute = static_cast<std::uint32_t>(tree_.attributes.size());
        for (auto a : n.attributes()) tree_.attributes.push_back({view(a.name()), view(a.value())});
        out.n_attributes = static_cast<std::uint32_t>(tree_.attributes.size()) - out.first_attribute;
        break;
      case pugi::node_cdata:
      case pugi::node_pcdata:
        out.kind = XmlNode::Kind::text;
        out.cdata = n.type() == pugi::node_cdata;
        out.content = view(n.value());
        break;
      case pugi::node_comment:
        out.kind = XmlNode::Kind::comment;
        out.content = view(n.value());
        break;
      default:
        return XmlNode::none;
    }
    tree_.nodes.push_back(out);
    return static_cast<std::uint32_t>(tree_.nodes.size() - 1);
  }

  std::string_view text_;
  const Copy& copy_;
  XmlTree& tree_;
};

/// Adds what helps against a fault; false: nothing does. `lost`: something of the text is gone then.
bool repair(std::string_view s, std::size_t at, pugi::xml_parse_status status, Repairs& repairs, bool& lost) {
  auto blank = [](char c) { return static_cast<unsigned char>(c) <= ' '; };
  at = std::min(at, s.size());
  lost = status != pugi::status_bad_attribute || at == 0 || at == s.size() || (s[at - 1] != '"' && s[at - 1] != '\'') ||
         blank(s[at]);
  if (!lost) {
    repairs.blanks.insert(std::ranges::upper_bound(repairs.blanks, at), at);
    return true;
  }
  auto begin = at, end = at;
  if (status == pugi::status_bad_attribute) {  // an attribute without quotes: the word that it is
    while (begin > 0 && !blank(s[begin - 1]) && s[begin - 1] != '<' && s[begin - 1] != '>') --begin;
    while (end < s.size() && !blank(s[end]) && s[end] != '>' && s[end] != '<' && s.substr(end, 2) != "/>") ++end;
    if (begin == end || begin == 0 || s[begin - 1] == '<') return false;
  } else if (status == pugi::status_unrecognized_tag) {
    begin = s.rfind('<', at);
    end = begin + 1;
    if (begin == s.npos || s.substr(begin).starts_with("<!") || s.substr(begin).starts_with("<?")) return false;
  } else {
    return false;
  }
  const std::pair range(begin, end);
  if (std::ranges::find(repairs.erased, range) != repairs.erased.end()) return false;
  repairs.erased.push_back(range);
  return true;
}

struct Cut {
  std::string_view text;  // with its brackets, if they are there
  bool complete = false;  // it ends with '>'
};

/// The tag at the beginning of `s`. '<' cannot be in a tag, not even between quotes, so a quote that is never closed
/// ends there.
Cut cut_tag(std::string_view s) {
  char quote = 0;
  for (std::size_t i = 1; i < s.size(); ++i) {
    const char c = s[i];
    if (c == '<') return {s.substr(0, i), false};
    if (quote)
      quote = c == quote ? 0 : quote;
    else if (c == '"' || c == '\'')
      quote = c;
    else if (c == '>')
      return {s.substr(0, i + 1), true};
  }
  return {s, false};
}

/// The declaration at the beginning of `s`, with what it holds between '[' and ']'.
std::string_view cut_doctype(std::string_view s) {
  char quote = 0;
  bool inside = false;
  for (std::size_t i = 2; i < s.size(); ++i) {
    const char c = s[i];
    if (quote)
      quote = c == quote ? 0 : quote;
    else if (c == '"' || c == '\'')
      quote = c;
    else if (c == '[' || c == ']')
      inside = c == '[';
    else if (c == '>' && !inside)
      return s.substr(0, i + 1);
  }
  return s;
}

struct Skipped {
  std::string_view begin, end;
};
constexpr Skipped skipped[] = {{"<!--", "-->"}, {"<![CDATA[", "]]>"}, {"<?", "?>"}};

}  // namespace

XmlTree read_xml(std::string_view text) {
  constexpr int most_repairs = 16;
  XmlTree tree;
  Repairs repairs;
  for (int i = 0;; ++i) {
    Copy copy(text, repairs);
    pugi::xml_document document;
    // No conversion of entities and line ends: values keep their length and place.
    const auto result = document.load_buffer_inplace(copy.bytes.data(), copy.bytes.size(),
                                                     pugi::parse_cdata | pugi::parse_comments, pugi::encoding_utf8);
    const auto at = copy.in_text(static_cast<std::size_t>(std::max<std::ptrdiff_t>(result.offset, 0)));
    bool lost = false;
    if (!result && i < most_repairs && repair(text, at, result.status, repairs, lost)) {
      tree.repaired.push_back({result.description(), at, lost});
      continue;
    }
    if (!result) {
      tree.fault = result.description();
      tree.fault_at = at;
    }
    Flattener(text, copy, tree).run(document);
    return tree;
  }
}

// ---- a tag at a time -----------------------------------------------------------------------------------------------

const XmlTag::Attribute* XmlTag::find(std::string_view attribute) const {
  auto found = std::ranges::find(attributes, attribute, &XmlTag::Attribute::name);
  return found == attributes.end() ? nullptr : &*found;
}

struct XmlReader::State {
  std::string_view text;
  std::uint32_t base;
  Diagnostics& diag;
  std::size_t at = 0;
  XmlTag tag;
  std::vector<XmlTag::Attribute> attributes;
  std::string buffer;  // the tag that pugixml reads, and changes in place
  pugi::xml_document document;

  Span span(std::string_view piece) const {
    return {base + static_cast<std::uint32_t>(piece.data() - text.data()), static_cast<std::uint32_t>(piece.size())};
  }
  std::string_view rest() const { return text.substr(at); }

  /// Past text, comments and declarations to the next tag; false at the end.
  bool find_tag() {
    while (at < text.size()) {
      const auto between = rest().substr(0, rest().find('<'));
      if (const auto words = trim(between); !words.empty())
        diag.report(Diag::stray_token, span(words), "text between tags");
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
    tag.kind = inner.starts_with('/') ? XmlTag::Kind::close
               : inner.ends_with('/') ? XmlTag::Kind::empty
                                      : XmlTag::Kind::open;
    if (tag.kind == XmlTag::Kind::close) inner.remove_prefix(1);
    if (tag.kind == XmlTag::Kind::empty) inner.remove_suffix(1);
    parse(inner);
  }

  /// `inner`: the name and what follows it.
  void parse(std::string_view inner) {
    buffer.assign("<").append(inner).append("/>");
    const auto result =
        document.load_buffer_inplace(buffer.data(), buffer.size(), pugi::parse_default, pugi::encoding_utf8);
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

XmlReader::XmlReader(std::string_view text, std::uint32_t base, Diagnostics& diag)
    : state_(new State{text, base, diag}) {}
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
