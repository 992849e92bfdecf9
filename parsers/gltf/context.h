// What the parts of the reader share: the file, the scene that grows, and what VRML cannot express.
#pragma once
#include <cmath>
#include <map>
#include <string>

#include "parsers/gltf/accessors.h"
#include "parsers/gltf/legal_names.h"
#include "scenegraph/scene.h"

namespace wrlkit::gltf_reader {

/// What is left out, by name, reported in one message; and what is kept of it as text, for a WorldInfo.
class Lost {
 public:
  /// The limit for all texts that are kept.
  static constexpr std::size_t max_kept = 1 << 20;

  void add(std::string_view what, Span where);
  /// An element's extras that are not VRML's, and extensions that are not known here.
  void keep(const File&, Json element);
  void report(Diagnostics&) const;
  /// "/materials/3/extensions/KHR_materials_sheen {...}"
  const std::vector<std::string>& kept() const { return kept_; }

 private:
  void keep(const File&, Json element, std::string_view member);

  std::map<std::string, std::size_t, std::less<>> names_;
  Span first_;
  std::vector<std::string> kept_;
  std::size_t kept_bytes_ = 0;
};

struct Context {
  File& file;
  Buffers& buffers;
  Accessors& accessors;
  Scene& scene;
  Lost& lost;
  LegalNames& names;

  Diagnostics& diag() const { return file.diag(); }
  /// A node that stands where a value of the JSON does.
  NodeId add(TypeId type, Json at) const { return scene.add(type, file.where(at)); }
  /// Gives a node a DEF name, changed where VRML does not allow it, which is reported.
  void set_name(NodeId, Json name) const;
};

/// An element's vrml97 extras: no Json when there are none.
inline Json vrml97(Json element) { return element["extras"]["vrml97"]; }

/// `guess` with as few decimals as `accepts` allows, or as it is.
template <class Accepts>
double shortest(double guess, Accepts accepts) {
  for (double step : {1e2, 1e3, 1e4, 1e6, 1e7, 1e8})
    if (double d = std::round(guess * step) / step; accepts(d)) return d;
  return guess;
}

/// Display-referred colours of linear ones (IEC 61966-2-1), in [0, 1]: the shortest that is this linear one, as a
/// float.
double display(double linear);

}  // namespace wrlkit::gltf_reader
