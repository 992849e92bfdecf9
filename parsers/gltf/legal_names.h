// Names of a glTF file as names that VRML can have: each stays another one.
#pragma once
#include <set>
#include <string>
#include <string_view>
#include <unordered_map>

#include "parsers/gltf/file.h"

namespace wrlkit::gltf_reader {

class LegalNames {
 public:
  explicit LegalNames(const File& file) : file_(file) {}

  /// What wrlkit has written was a name in VRML or X3D, and stays as it is if readers of VRML take it for one; names of
  /// others become those that the standard allows.
  std::string of(std::string_view name);

 private:
  std::string fresh(std::string_view name);

  const File& file_;
  std::set<std::string> taken_;  // names of the file, and those that were given; empty until one is needed
  std::unordered_map<std::string, std::string> given_;
};

/// All names in a part of the file, wherever they stand.
void collect_names(Json, std::set<std::string>&);

}  // namespace wrlkit::gltf_reader
