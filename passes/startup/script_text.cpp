#include "passes/startup/script_text.h"

#include <algorithm>
#include <array>
#include <cctype>

#include "base/text/letter_case.h"
#include "scenegraph/nodes.h"

namespace wrlkit {
namespace {

constexpr std::string_view languages[] = {"javascript:", "ecmascript:", "vrmlscript:"};

std::string_view without_blanks(std::string_view s) {
  s.remove_prefix(std::min(s.find_first_not_of(" \t\r\n"), s.size()));
  return s;
}

/// What follows the name of the language; none: the url is none of these.
std::optional<std::string_view> program_in(std::string_view url) {
  url = without_blanks(url);
  for (const auto language : languages)
    if (starts_with_ignoring_case(url, language)) return url.substr(language.size());
  return std::nullopt;
}

std::span<const std::string_view> urls_of(const Scene& scene, NodeId script) {
  const Value& v = scene.value(script, nodes::script::url.slot);
  return v.is || v.type != FieldType::MFString ? std::span<const std::string_view>{} : v.text_span();
}

bool is_file_of_ecmascript(std::string_view url) {
  return ends_with_ignoring_case(url.substr(0, url.find_first_of("?#")), ".js");
}

bool is_letter(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' || c == '$'; }

/// "function initialize", with blanks between them.
bool declares_initialize(std::string_view program) {
  constexpr std::string_view word = "function", name = "initialize";
  for (auto at = program.find(word); at != program.npos; at = program.find(word, at + word.size())) {
    const auto rest = program.substr(at + word.size()), next = without_blanks(rest);
    if (next.size() == rest.size() || !next.starts_with(name)) continue;
    if (next.size() == name.size() || !is_letter(next[name.size()])) return true;
  }
  return false;
}

}  // namespace

bool is_script(const Scene& scene, NodeId n) { return n && scene.type(n).name == "Script"; }

std::size_t n_common_script_fields() { return builtin_nodes()[nodes::Script.value].fields.size(); }

bool has_initialize(const Scene& scene, NodeId script) {
  return is_script(scene, script) && std::ranges::any_of(urls_of(scene, script), [](std::string_view url) {
           const auto program = program_in(url);
           return program && declares_initialize(*program);
         });
}

bool is_script_in_file(const Scene& scene, NodeId n) {
  if (!is_script(scene, n)) return false;
  const auto urls = urls_of(scene, n);
  return std::ranges::any_of(urls, is_file_of_ecmascript) &&
         std::ranges::none_of(urls, [](std::string_view url) { return program_in(url).has_value(); });
}

std::optional<std::string> script_text(const Scene& scene, NodeId script, Resources* resources, Diagnostics& diag) {
  for (const auto url : urls_of(scene, script)) {
    if (const auto program = program_in(url)) return std::string(*program);
    if (!is_file_of_ecmascript(url) || !resources) continue;
    const std::array one{url};
    if (const auto file = resources->bytes(one, scene.where(script), diag)) return file->bytes;
  }
  return std::nullopt;
}

}  // namespace wrlkit
