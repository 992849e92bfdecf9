#include "parsers/gltf/context.h"

#include <algorithm>
#include <cmath>

#include "base/image/srgb.h"
#include "scenegraph/gltf_extensions.h"

namespace wrlkit::gltf_reader {
namespace {

/// JSON without the blanks between its tokens.
std::string compact(std::string_view s) {
  std::string out;
  bool quoted = false;
  for (std::size_t i = 0; i < s.size(); ++i) {
    if (quoted && s[i] == '\\' && i + 1 < s.size())
      out += s[i++];
    else if (s[i] == '"')
      quoted = !quoted;
    if (quoted || static_cast<unsigned char>(s[i]) > ' ') out += s[i];
  }
  return out;
}

}  // namespace

void Lost::add(std::string_view what, Span where) {
  if (names_.empty()) first_ = where;
  auto at = names_.find(what);
  if (at == names_.end()) at = names_.emplace(what, 0).first;
  ++at->second;
}

void Lost::report(Diagnostics& diag) const {
  constexpr std::size_t most = 40;
  std::string all;
  std::size_t n = 0;
  for (const auto& [name, count] : names_) {
    if (++n > most) {
      all += ", ... (" + std::to_string(names_.size()) + " kinds)";
      break;
    }
    if (!all.empty()) all += ", ";
    all += name;
    if (count > 1) all += " (" + std::to_string(count) + ")";
  }
  if (!names_.empty()) diag.report(Diag::no_vrml_word, first_, all);
}

void Lost::keep(const File& file, Json element, std::string_view member) {
  auto text = compact(element.source());
  if (text.size() > max_kept - kept_bytes_) return add("extras beyond 1 MiB", file.where(element));
  kept_bytes_ += text.size();
  kept_.push_back(std::string(member) + " " + text);
}

void Lost::keep(const File& file, Json element) {
  for (Json e : element["extensions"].is_object() ? element["extensions"] : Json()) {
    if (reads_gltf_extension(e.key())) continue;
    add(e.key(), file.where(e));
    keep(file, e, std::string(element["name"].text()) + ": " + std::string(e.key()));
  }
  for (Json e : element["extras"].is_object() ? element["extras"] : Json())
    if (e.key() != "vrml97" && e.key() != "MSFT_screencoverage")
      keep(file, e, std::string(element["name"].text()) + ": extras." + std::string(e.key()));
}

void Context::set_name(NodeId n, Json name) const {
  if (name.text().empty()) return;
  const auto legal = names.of(name.text());
  if (legal != name.text()) diag().report(Diag::name_changed, file.where(name), name.text(), legal);
  scene.set_name(n, legal);
}

double display(double l) {
  if (!(l > 0)) return 0;
  if (l >= 1) return 1;
  const double guess = linear_to_srgb(l);
  // Writers convert either the number or the float that it is stored as.
  return shortest(guess, [f = static_cast<float>(l)](double d) {
    return static_cast<float>(srgb_to_linear(d)) == f || static_cast<float>(srgb_to_linear(static_cast<float>(d))) == f;
  });
}

}  // namespace wrlkit::gltf_reader
