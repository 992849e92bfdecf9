#include "scenegraph/places/name_path.h"

namespace wrlkit {
namespace {

constexpr std::string_view slash = "%2F", percent = "%25";

bool is_escape(std::string_view text) { return text.starts_with(slash) || text.starts_with(percent); }

}  // namespace

std::string path_step(std::string_view name) {
  std::string out;
  for (std::size_t i = 0; i < name.size(); ++i) {
    if (name[i] == '/')
      out += slash;
    else if (is_escape(name.substr(i)))
      out += percent;
    else
      out += name[i];
  }
  return out;
}

std::string path_below(std::string_view path, std::string_view name) {
  std::string out(path);
  if (!out.empty()) out += '/';
  return out += path_step(name);
}

std::string name_of_step(std::string_view step) {
  std::string out;
  for (std::size_t i = 0; i < step.size(); ++i) {
    const auto rest = step.substr(i);
    out += rest.starts_with(slash) ? '/' : rest[0];
    if (is_escape(rest)) i += slash.size() - 1;
  }
  return out;
}

std::vector<std::string_view> path_steps(std::string_view path) {
  std::vector<std::string_view> out;
  for (std::size_t from = 0;;) {
    const auto to = path.find('/', from);
    out.push_back(path.substr(from, to - from));
    if (to == path.npos) return out;
    from = to + 1;
  }
}

}  // namespace wrlkit
