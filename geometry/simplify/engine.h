// The engine behind Collapser: takes the cheapest edge that may go, collapses it, prices again what has changed.
//
// Every vertex is in the queue with the cost of the cheapest edge that it has to offer, whether or not that edge may
// go. Only at the top of the queue this is looked at: the vertex is priced once more, and goes back into the queue when
// it has become dearer, or when it is the next best edge that may go. An edge whose best place would turn a face over
// is offered at both its ends instead.
//
// After a collapse only the vertex that is left is priced, with all its edges; in a large mesh (sweeping_), later. What
// became dearer around it is found at the top of the queue; what became cheaper there, a little late. That saves time
// and costs no quality (rationale.md). Small meshes under the paper's formulas are exact (exact_): the order is then
// the paper's. A large mesh becomes a small one when few faces are left.
#pragma once
#include "geometry/simplify/criterion.h"
#include "geometry/simplify/queue.h"
#include "geometry/simplify/simplifier.h"

namespace wrlkit::simplify {

class Engine final : public Simplifier {
 public:
  Engine(const Mesh& mesh, const CollapseOptions& options);

  void run_to(std::size_t n_faces, double max_error) override;
  std::size_t n_faces() const override { return surface_.n_faces(); }
  std::optional<EdgeCollapse> next() override;
  std::optional<double> cost(std::uint32_t from, std::uint32_t to) override;

 private:
  /// Why an edge may not go. What would spoil the shape of a face may do better at one end of the edge.
  enum class Refusal { none, topology, shape };
  /// What is going to be done to the vertices of from_ and to_.
  struct Move {
    double cost;
    Vec3 position;
  };

  /// Brings the cheapest collapse that may be done into from_ and to_. False when there is none.
  bool settle(Move& move);
  bool settle_vertex(std::uint32_t v, Move& move);
  Refusal refusal(const Option& option);
  double cost_of_fold(const Option& option) const;
  void collapse(const Move& move);
  void merge_vertices(const Vec3& position);
  void sweep();
  void sort_exactly();
  void refresh_all();
  void refresh(std::uint32_t v, int spokes);
  void offer(const Ring& ring, int spokes);
  void enqueue(const Ring& ring, const Option* best);
  Option* cheapest();
  void merge_wedges(const Vec3& position);
  void record_corners();

  std::unique_ptr<Pricer> pricer_;
  std::unique_ptr<VertexQueue> queue_;
  std::vector<std::uint32_t> best_;  // the other end of the edge that a vertex is in the queue for
  std::vector<float> deviation_;     // of each vertex, from the surface that came in
  bool recording_;
  bool sweeping_ = false;
  bool exact_ = false;  // the neighbours of a collapse are priced at once, not when they come to the top of the queue

  Ring from_, to_, ring_;
  std::vector<Option> options_;
};

}  // namespace wrlkit::simplify
