// Where Shapes stand that never move against one another, and what keeps others apart.
#pragma once
#include <string>
#include <vector>

#include "passes/analysis/usage.h"
#include "scenegraph/places/ways.h"
#include "scenegraph/transform.h"

namespace wrlkit {

/// A group within which nothing moves, and out of which nothing may be taken. The world is the first, without a node.
struct Zone {
  NodeId holder;
  std::uint32_t times = 0;  // it is drawn
};

struct StillPlace {
  NodeId shape;
  std::uint32_t zone;
  Matrix frame;        // to the zone
  std::uint32_t path;  // into StillPlaces::paths
};

class StillPlaces {
 public:
  /// The places of the main scope. `by_name`: nothing is taken out of a group with a name. O(nodes and places).
  StillPlaces(const Scene& scene, const Usage& usage, bool by_name = false);

  /// More places than can be handled: nothing is known.
  bool too_many() const { return ways_.too_many(); }
  const std::vector<Zone>& zones() const { return zones_; }
  /// Of Shapes that may be taken out of their groups, all places of each; in the order of the file.
  const std::vector<StillPlace>& places() const { return places_; }
  /// Places of other Shapes with geometry, as they are shown.
  std::size_t n_fixed() const { return n_fixed_; }
  /// Groups out of which Shapes may be taken.
  const std::vector<NodeId>& groups() const { return groups_; }
  /// The named nodes from the root to a place: "Unit/Pump"; the same for all Shapes below the last of them.
  std::string name(std::uint32_t path) const;

 private:
  struct Step {
    std::string_view name;
    std::uint32_t above;
  };
  struct Handed {  // down to children
    std::uint32_t zone;
    Matrix frame;
    std::uint32_t path;
    bool shown;
  };
  void find_bound();
  void find_alternatives();
  void walk();
  void visit(NodeId node, const Handed&);
  void children(NodeId group, const Handed& as);
  void alternatives(NodeId node, const Handed&);
  std::uint32_t zone_of(NodeId holder, bool shown, bool& fresh);
  bool may_take(NodeId shape) const;
  bool is_plain(NodeId n) const { return wrlkit::is_plain(scene_, usage_, n); }
  bool is_apart(NodeId group) const;

  const Scene& scene_;
  const Usage& usage_;
  bool by_name_;
  std::vector<char> bound_;             // by node: of a prototype, or below what is not known
  std::vector<std::uint32_t> takers_;   // by node: lists out of which it may be taken
  std::vector<std::uint32_t> chosen_;   // by node: how often it is a child of a Switch or LOD
  std::vector<std::uint32_t> zone_at_;  // by node, plus one
  std::vector<char> listed_, fixed_, named_;
  std::vector<Zone> zones_{Zone{.times = 1}};
  std::vector<StillPlace> places_;
  std::vector<NodeId> groups_;
  std::vector<Step> paths_{Step{}};
  Ways<Handed> ways_;
  std::size_t n_fixed_ = 0;
};

}  // namespace wrlkit
