#include "parsers/x3d/page.h"

#include <algorithm>
#include <map>

#include "base/text/letter_case.h"
#include "parsers/x3d/xml.h"
#include "scenegraph/node_table.h"

namespace wrlkit::x3d {
namespace {

/// By their small letters.
using Spelling = std::map<std::string, std::string_view>;

Spelling spelled(std::initializer_list<std::string_view> words) {
  Spelling out;
  for (auto w : words) out[lower_case(w)] = w;
  return out;
}

const Spelling& elements() {
  static const Spelling all = [] {
    Spelling out = spelled({"X3D", "Scene", "head", "meta", "component", "unit", "ROUTE", "ProtoDeclare",
                            "ProtoInterface", "ProtoBody", "ProtoInstance", "ExternProtoDeclare", "IS", "connect",
                            "field", "fieldValue", "IMPORT", "EXPORT"});
    for (const auto& t : builtin_nodes())
      if (t.dialects & static_cast<DialectSet>(Dialect::x3d)) out[lower_case(t.name)] = t.name;
    return out;
  }();
  return all;
}

const Spelling& attributes() {
  static const Spelling all = [] {
    Spelling out;
    for (const auto& t : builtin_nodes())
      if (t.dialects & static_cast<DialectSet>(Dialect::x3d))
        for (const auto& f : t.fields) out[lower_case(f.name)] = f.name;
    out.merge(spelled({"DEF", "USE", "containerField", "fromNode", "fromField", "toNode", "toField", "nodeField",
                       "protoField", "accessType", "inlineDEF", "importedDEF", "exportedDEF", "localDEF", "AS",
                       "conversionFactor"}));
    return out;
  }();
  return all;
}

bool blank(char c) { return static_cast<unsigned char>(c) <= ' '; }

void spell(std::string& xml, std::size_t at, std::size_t n, const Spelling& table) {
  if (auto i = table.find(lower_case(std::string_view(xml).substr(at, n))); i != table.end())
    xml.replace(at, n, i->second);
}

/// The attributes of the tag whose name ends at `at`; where it ends.
std::size_t tag(std::string& xml, std::size_t at) {
  auto ends = [&] {
    return at >= xml.size() || xml[at] == '>' || xml[at] == '<' ||
           (xml[at] == '/' && at + 1 < xml.size() && xml[at + 1] == '>');
  };
  while (!ends()) {
    if (blank(xml[at])) {
      ++at;
      continue;
    }
    const auto name = at;
    while (!ends() && !blank(xml[at]) && xml[at] != '=') ++at;
    const auto length = at - name;
    while (!ends() && blank(xml[at])) ++at;
    const bool has_value = !ends() && xml[at] == '=' && length > 0;
    if (has_value) do
        ++at;
      while (!ends() && blank(xml[at]));
    const char quote = has_value && !ends() ? xml[at] : 0;
    const bool of_page = lower_case(std::string_view(xml).substr(name, std::min<std::size_t>(length, 2))) == "on" &&
                         length > 2;  // onclick
    if ((quote == '"' || quote == '\'') && !of_page) {
      spell(xml, name, length, attributes());
      at = std::min(xml.find(quote, at + 1), xml.size() - 1) + 1;
    } else {
      if (of_page && (quote == '"' || quote == '\''))
        at = std::min(xml.find(quote, at + 1), xml.size() - 1) + 1;
      else if (has_value)
        while (!ends() && !blank(xml[at])) ++at;
      if (at == name) ++at;
      std::fill(xml.begin() + static_cast<std::ptrdiff_t>(name), xml.begin() + static_cast<std::ptrdiff_t>(at), ' ');
    }
  }
  return at;
}

}  // namespace

std::optional<PageWorld> world_of_page(std::string_view text) {
  if (lower_case(first_element(text)) != "html") return std::nullopt;
  const std::string small = lower_case(text);
  std::size_t begin = 0;
  do begin = small.find("<x3d", begin + 1);
  while (begin != small.npos && begin + 4 < small.size() && !blank(small[begin + 4]) && small[begin + 4] != '>');
  if (begin == small.npos) return std::nullopt;
  constexpr std::string_view close = "</x3d>";
  const auto found = small.find(close, begin), end = found == small.npos ? small.size() : found + close.size();
  PageWorld out{std::string(text.substr(begin, end - begin)), begin};
  for (std::size_t at = 0; (at = out.xml.find('<', at)) != out.xml.npos;) {
    constexpr std::string_view whole[][2] = {{"<!--", "-->"}, {"<![CDATA[", "]]>"}};
    auto skipped =
        std::ranges::find_if(whole, [&](const auto& w) { return out.xml.compare(at, w[0].size(), w[0]) == 0; });
    if (skipped != std::end(whole)) {
      at = std::min(out.xml.find((*skipped)[1], at), out.xml.size());
      continue;
    }
    const bool closes = at + 1 < out.xml.size() && out.xml[at + 1] == '/';
    const auto name = at + 1 + closes;
    at = std::min(out.xml.find_first_of(" \t\r\n/><", name), out.xml.size());
    spell(out.xml, name, at - name, elements());
    if (!closes) at = tag(out.xml, at);
  }
  return out;
}

}  // namespace wrlkit::x3d
