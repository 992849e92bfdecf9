// Where the Shapes of a scene stand, with the DEF names on the way to each of them: how a part is called.
#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "scenegraph/scene.h"
#include "scenegraph/transform.h"

namespace wrlkit {

struct NamedPlace {
  NodeId shape;
  Matrix frame;        // to the world
  std::uint32_t path;  // into NamedPlaces: the same for all Shapes below one named node
};

class NamedPlaces {
 public:
  /// The places of what is shown: the chosen child of a Switch, the first level of a LOD. O(nodes and places).
  explicit NamedPlaces(const Scene& scene);

  /// In the order of the file.
  const std::vector<NamedPlace>& places() const { return places_; }
  /// There were more ways than may be followed (ways.h); what is behind them is left out.
  bool too_many() const { return too_many_; }
  /// The names from the root to a place with '/' between them: "Unit/Pump" (name_path.h). Paths that differ have
  /// different names: the second of one name is "Unit/Pump#2". Empty where nothing has a name.
  const std::string& name(std::uint32_t path) const { return names_[path]; }

 private:
  struct Step {
    std::string_view name;
    std::uint32_t above;
  };
  std::uint32_t below(std::uint32_t path, std::string_view name);
  void make_names();

  std::vector<NamedPlace> places_;
  std::vector<Step> steps_{Step{}};
  std::vector<std::string> names_;
  bool too_many_ = false;
};

}  // namespace wrlkit
