#include "tests/fuzz/world_mutator.h"

#include <cctype>
#include <utility>

#include "parsers/parsers.h"

namespace wrlkit {
namespace {

bool is_word(char c) { return std::isalnum(static_cast<unsigned char>(c)) || c == '_' || c == '.' || c == '-'; }

/// Behind the string that begins at `at`.
std::size_t behind_string(std::string_view text, std::size_t at) {
  const char quote = text[at];
  for (++at; at < text.size() && text[at] != quote; ++at)
    if (text[at] == '\\') ++at;
  return std::min(at + 1, text.size());
}

const NodeType* type_of(std::string_view name, Dialect dialect) {
  const TypeId t = find_builtin(name, dialect);
  return t ? &builtin_nodes()[t.value] : nullptr;
}

std::vector<NodePlace> nodes_in_vrml(std::string_view text, Dialect dialect) {
  std::vector<NodePlace> open, closed;
  std::pair<std::size_t, std::size_t> words[3] = {};  // the last ones, by begin and end
  const auto word = [&](int i) { return text.substr(words[i].first, words[i].second - words[i].first); };
  for (std::size_t at = 0; at < text.size();) {
    const char c = text[at];
    if (c == '"') {
      at = behind_string(text, at);
    } else if (c == '#') {
      at = std::min(text.find('\n', at), text.size());
    } else if (is_word(c)) {
      const auto begin = at;
      while (at < text.size() && is_word(text[at])) ++at;
      words[0] = std::exchange(words[1], std::exchange(words[2], {begin, at}));
    } else {
      ++at;
      if (c == '{') {
        const bool is_named = word(0) == "DEF";
        open.push_back({.type = type_of(word(2), dialect),
                        .name = std::string(is_named ? word(1) : ""),
                        .begin = words[is_named ? 0 : 2].first,
                        .attributes = at,
                        .body = at});
      } else if (c == '}' && !open.empty()) {
        closed.push_back(open.back());
        closed.back().end = at;
        open.pop_back();
      }
    }
  }
  return closed;
}

/// The value of an attribute of a tag, if it has it.
std::string attribute_of(std::string_view tag, std::string_view name) {
  const auto at = tag.find(" " + std::string(name) + "=");
  const auto quote = at == tag.npos ? tag.npos : at + name.size() + 2;
  if (quote >= tag.size()) return {};
  const auto end = tag.find(tag[quote], quote + 1);
  return std::string(end == tag.npos ? "" : tag.substr(quote + 1, end - quote - 1));
}

std::vector<NodePlace> nodes_in_xml(std::string_view text) {
  std::vector<NodePlace> open, closed;
  for (auto at = text.find('<'); at != text.npos; at = text.find('<', at)) {
    auto end = at + 1;
    while (end < text.size() && text[end] != '>')
      end = text[end] == '"' || text[end] == '\'' ? behind_string(text, end) : end + 1;
    if (end >= text.size()) break;
    const auto tag = text.substr(at, ++end - at);
    if (tag.starts_with("</")) {
      if (!open.empty()) {
        closed.push_back(open.back());
        closed.back().end = end;
        open.pop_back();
      }
    } else if (is_word(tag[1])) {
      auto name_end = at + 1;
      while (is_word(text[name_end])) ++name_end;
      NodePlace place{.type = type_of(text.substr(at + 1, name_end - at - 1), Dialect::x3d),
                      .name = attribute_of(tag, "DEF"),
                      .begin = at,
                      .end = end,
                      .attributes = name_end,
                      .body = end,
                      .is_closed_tag = tag.ends_with("/>")};
      (place.is_closed_tag ? closed : open).push_back(std::move(place));
    }
    at = end;
  }
  return closed;
}

class Mutation {
 public:
  Mutation(std::string& text, Dialect dialect, Encoding encoding, std::mt19937& random)
      : text_(text),
        dialect_(dialect),
        encoding_(encoding),
        random_(random),
        places_(nodes_in(text, dialect, encoding)) {}

  void run() {
    std::vector<NamedNode> named;
    for (const auto& p : places_)
      if (p.type && !p.name.empty()) named.push_back({p.name, p.type});
    WorldText make(dialect_, encoding_, random_, std::move(named));
    switch (random_() % 8) {
      case 0:
      case 1:
      case 2:
        return put_field(make);
      case 3:
        return put_at_end(make.root());
      case 4:
        return put_at_end(dialect_ == Dialect::vrml1 ? make.root() : make.proto());
      case 5:
        return put_at_end(dialect_ == Dialect::vrml1 ? make.root() : make.route());
      case 6:
        return random_() % 2 ? remove_node() : copy_node();
      default:
        return change_number(make);
    }
  }

 private:
  void put_field(WorldText& make) {
    std::erase_if(places_, [](const NodePlace& p) { return !p.type; });
    if (places_.empty()) return put_at_end(make.root());
    const auto& place = one_place();
    const auto field = make.field(*place.type);
    if (place.is_closed_tag && !field.content.empty()) {
      text_.replace(place.end - 2, 2, ">" + field.content + "</" + std::string(place.type->name) + ">");
    } else {
      text_.insert(place.body, field.content);
    }
    text_.insert(place.attributes, field.attribute);
  }

  void put_at_end(const std::string& what) {
    const auto end = encoding_ == Encoding::xml ? text_.rfind("</Scene>") : text_.npos;
    text_.insert(std::min(end, text_.size()), what);
  }

  void remove_node() {
    if (places_.empty()) return;
    const auto& p = one_place();
    text_.erase(p.begin, p.end - p.begin);
  }

  void copy_node() {
    if (places_.empty()) return;
    const auto& from = one_place();
    const auto& to = one_place();
    text_.insert(to.begin, text_.substr(from.begin, from.end - from.begin) + "\n");
  }

  void change_number(WorldText& make) {
    const auto at = text_.find_first_of("0123456789", random_() % (text_.size() + 1));
    if (at == text_.npos) return;
    const auto end = std::min(text_.find_first_not_of("0123456789.", at), text_.size());
    text_.replace(at, end - at, make.number());
  }

  const NodePlace& one_place() { return places_[random_() % places_.size()]; }

  std::string& text_;
  Dialect dialect_;
  Encoding encoding_;
  std::mt19937& random_;
  std::vector<NodePlace> places_;
};

}  // namespace

std::vector<NodePlace> nodes_in(std::string_view text, Dialect dialect, Encoding encoding) {
  return encoding == Encoding::vrml ? nodes_in_vrml(text, dialect) : nodes_in_xml(text);
}

std::string mutated_world(std::string text, Format format, std::mt19937& random) {
  if (const auto said = sniff_format(text); said != Format::none && said != Format::gltf) format = said;
  const auto dialect = format == Format::vrml97  ? Dialect::vrml97
                       : format == Format::vrml1 ? Dialect::vrml1
                                                 : Dialect::x3d;
  const auto encoding = format == Format::x3d_xml ? Encoding::xml : Encoding::vrml;
  if (text.size() < 20 || random() % 64 == 0) return WorldText(dialect, encoding, random).file();
  for (auto n = 1 + random() % 3; n > 0; --n) Mutation(text, dialect, encoding, random).run();
  return text;
}

}  // namespace wrlkit
