// Fields of nodes that are not in the node table, which are kept as text.
#pragma once
#include <string_view>
#include <vector>

#include "scenegraph/scene.h"

namespace wrlkit::x3d {

class ForeignFields {
 public:
  ForeignFields(const Scene& scene, NodeId n) : scene_(scene), n_(n) {}

  /// Null where there is none, or it IS another one.
  const Value* value(std::string_view name) const;
  /// All numbers of a field, finite or not; none where there is no such field.
  std::vector<double> numbers(std::string_view name) const;
  /// The first one, if it is finite.
  double number(std::string_view name, double otherwise) const;
  bool flag(std::string_view name, bool otherwise) const;

 private:
  const Scene& scene_;
  NodeId n_;
};

}  // namespace wrlkit::x3d
