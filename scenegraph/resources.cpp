#include "scenegraph/resources.h"

#include <algorithm>

namespace wrlkit {

std::string Resources::add_made(MadeFile file) {
  const auto dot = std::min(file.name.find_last_of('.'), file.name.size());
  const std::string stem = file.name.substr(0, dot), extension = file.name.substr(dot);
  auto url = [&] { return std::string(made_scheme) + file.name; };
  for (int i = 2; find_made(url()); ++i) file.name = stem + "_" + std::to_string(i) + extension;
  made_.push_back(std::move(file));
  return std::string(made_scheme) + made_.back().name;
}

const MadeFile* Resources::find_made(std::string_view url) const {
  if (!url.starts_with(made_scheme)) return nullptr;
  auto i = std::ranges::find(made_, url.substr(made_scheme.size()), &MadeFile::name);
  return i == made_.end() ? nullptr : &*i;
}

void Resources::keep_made(std::size_t n) {
  for (; made_.size() > n; made_.pop_back()) forget(std::string(made_scheme) + made_.back().name);
}

void Resources::add_named(NamedFile file) {
  std::erase_if(named_, [&](const NamedFile& n) { return n.path == file.path; });
  named_.push_back(std::move(file));
}

}  // namespace wrlkit
