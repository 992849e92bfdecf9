#include "geometry/simplify/engine.h"

#include <algorithm>
#include <cmath>

#include "base/stop.h"
#include "geometry/simplify/features.h"
#include "geometry/simplify/legality.h"
#include "geometry/simplify/sweep.h"

namespace wrlkit::simplify {
namespace {

constexpr std::uint32_t many_vertices = 1 << 15;  // from which on a mesh is simplified in sweeps
constexpr std::size_t few_faces = 1 << 14;        // until this many are left
constexpr double fold_weight = 0.1;  // of the faces that an end takes along; 1: folds stay that nobody needs

/// Where x is along the edge from a (0) to b (1).
double along(const Vec3& a, const Vec3& b, const Vec3& x) {
  Vec3 e = b - a;
  double l = dot(e, e);
  return l > 0 ? std::clamp(dot(x - a, e) / l, 0., 1.) : 0;
}

}  // namespace

Engine::Engine(const Mesh& mesh, const CollapseOptions& options)
    : Simplifier(mesh),
      best_(surface_.n_vertices(), none),
      deviation_(surface_.n_vertices()),
      recording_(options.record) {
  find_features(surface_, wedges_, {options.keep_borders, options.keep_creases, options.crease_angle, options.fixed});
  pricer_ = make_pricer(options.criterion, surface_, wedges_);
  if (recording_) recorder_.begin(surface_, wedges_);
  if (surface_.n_vertices() < many_vertices)
    sort_exactly();
  else
    sweep();
}

void Engine::sweep() {
  queue_ = std::make_unique<SweepQueue>(surface_.n_vertices(), pricer_->one_way() ? 1 : 2);
  sweeping_ = true;
  refresh_all();
}

void Engine::sort_exactly() {
  queue_ = std::make_unique<HeapQueue>(surface_.n_vertices());
  sweeping_ = false;
  exact_ = pricer_->one_way();
  refresh_all();
}

void Engine::refresh_all() {
  for (std::uint32_t v = 0; v < surface_.n_vertices(); ++v) refresh(v, Pricer::own);
}

void Engine::refresh(std::uint32_t v, int spokes) {
  if (surface_.gather(v, ring_))
    offer(ring_, spokes);
  else
    queue_->remove(v);
}

/// Prices the centre and puts it into the queue.
void Engine::offer(const Ring& ring, int spokes) {
  options_.clear();
  pricer_->price(ring, spokes, options_);
  enqueue(ring, cheapest());
}

void Engine::enqueue(const Ring& ring, const Option* best) {
  if (!best) return queue_->remove(ring.center);
  queue_->set(ring.center, queue_->key(best->cost));
  best_[ring.center] = ring.spokes[best->spoke].vertex;
}

Option* Engine::cheapest() {
  Option* best = nullptr;
  for (Option& o : options_)
    if (o.cost >= 0 && (!best || o.cost < best->cost)) best = &o;
  return best;
}

bool Engine::settle(Move& move) {
  if (sweeping_ && surface_.n_faces() < few_faces) sort_exactly();
  while (!queue_->empty())
    if (settle_vertex(queue_->top(), move)) return true;
  return false;
}

/// For the vertex at the top of the queue. False when it is not the cheapest after all.
bool Engine::settle_vertex(std::uint32_t v, Move& move) {
  if (!surface_.gather(v, from_)) {
    queue_->remove(v);
    return false;
  }
  const VertexQueue::Key key = queue_->top_key();
  options_.clear();
  if (int s = from_.find(best_[v]); s >= 0) pricer_->price(from_, s, options_);
  Option* best = cheapest();
  bool all = false;
  while (true) {
    if (!best || queue_->key(best->cost) > key) {
      if (all) break;
      options_.clear();
      pricer_->price(from_, Pricer::every, options_);
      all = true;
    } else if (const Refusal why = refusal(*best); why != Refusal::none) {
      if (!all) best_[v] = none;
      best->cost = -1;
      if (why == Refusal::shape && best->where == Placement::anywhere && !pricer_->one_way())
        pricer_->price_ends(from_, best->spoke, options_);
    } else if (best->cost = std::max(best->cost, cost_of_fold(*best)); queue_->key(best->cost) <= key) {
      move = {best->cost, best->position};
      if (move.position == surface_.position(from_.center)) std::swap(from_, to_);
      return true;
    }
    best = cheapest();
  }
  enqueue(from_, best);
  return false;
}

/// Brings the other end of the edge into to_. The formulas of the paper may fold, as the paper has them.
Engine::Refusal Engine::refusal(const Option& option) {
  if (!surface_.gather(from_.spokes[option.spoke].vertex, to_) || !keeps_topology(from_, to_)) return Refusal::topology;
  return keeps_shape(surface_, from_, to_, option.position, pricer_->one_way()) ? Refusal::none : Refusal::shape;
}

/// What an end that is drawn in costs, as if a part of the faces around moved so far. The formulas of the paper are let
/// alone.
double Engine::cost_of_fold(const Option& option) const {
  const double loss = pricer_->one_way() ? 0 : squared_loss_at_fold(surface_, from_, to_, option.position);
  if (loss == 0) return 0;
  double area = 0;
  for (const Ring::Face& f : from_.face_span()) area += length(surface_.normal(f.face));
  for (const Ring::Face& f : to_.face_span()) area += length(surface_.normal(f.face));
  return fold_weight * loss * area;
}

void Engine::run_to(std::size_t n_faces, double max_error) {
  Move move;
  std::vector<std::uint32_t> too_far;  // for a later call
  while (surface_.n_faces() > n_faces && settle(move)) {
    check_stop();
    std::uint32_t u = from_.center, v = to_.center;
    double d = std::max(deviation_[u], deviation_[v]) + deviation(surface_, from_, to_, move.position);
    if (d > max_error) {
      too_far.push_back(queue_->top());
      queue_->remove(queue_->top());
      continue;
    }
    deviation_[v] = static_cast<float>(d);
    error_ = std::max(error_, d);
    collapse(move);
  }
  for (std::uint32_t v : too_far) refresh(v, Pricer::every);
}

void Engine::collapse(const Move& move) {
  const std::uint32_t u = from_.center, v = to_.center;
  const Vec3 old = surface_.position(v);
  pricer_->before_merge(from_, to_, move.position);
  if (wedges_.present()) merge_wedges(move.position);
  if (recording_) record_corners();
  merge_vertices(move.position);
  pricer_->after_merge(from_, to_);
  if (recording_)
    recorder_.end_step({surface_.original(u), surface_.original(v), move.position, move.cost}, surface_.position(u),
                       old, error_);
  queue_->remove(u);
  best_[v] = none;
  if (!queue_->put_off(v)) refresh(v, Pricer::every);
  auto refresh_if_needed = [&](std::uint32_t w) {
    if (exact_ || !queue_->contains(w)) refresh(w, Pricer::every);
  };
  for (const Ring::Spoke& s : to_.spoke_span())
    if (s.vertex != u) refresh_if_needed(s.vertex);
  for (const Ring::Spoke& s : from_.spoke_span())
    if (s.vertex != v && to_.find(s.vertex) < 0) refresh_if_needed(s.vertex);
}

/// Kinds of vertices change only where features end in the third corner of a face that goes.
void Engine::merge_vertices(const Vec3& position) {
  const std::uint32_t u = from_.center, v = to_.center;
  std::uint32_t third[Ring::max_faces + 1];
  int n = 0;
  bool features = false;
  for (const Ring::Face& f : from_.face_span()) {
    if (!from_.has(f, v)) continue;
    features |= surface_.face[f.face].features != 0;
    third[n++] = from_.next_vertex(f) == v ? from_.prev_vertex(f) : from_.next_vertex(f);
  }
  surface_.merge(from_, to_);
  surface_.vertex[v].position = position;
  if (surface_.vertex[u].kind == Kind::fixed) surface_.vertex[v].kind = surface_.vertex[v].crease_kind = Kind::fixed;
  if (!features) return;
  third[n++] = v;
  for (int i = 0; i < n; ++i)
    if (surface_.gather(third[i], ring_)) surface_.classify(ring_);
}

/// The wedges at both ends of the edge become one in each of its faces; the others of `from_` go along as they are.
void Engine::merge_wedges(const Vec3& position) {
  const std::uint32_t v = to_.center;
  const double t = along(surface_.position(from_.center), surface_.position(v), position);
  struct Pair {
    std::uint32_t from, to;
  };
  Pair pairs[Ring::max_faces];
  int n = 0;
  for (const Ring::Face& f : from_.face_span()) {
    if (!from_.has(f, v)) continue;
    const auto& wedge = wedges_.of_face[f.face];
    pairs[n++] = {wedge[f.corner], wedge[(f.corner + (from_.next_vertex(f) == v ? 1 : 2)) % 3]};
  }
  for (int i = 0; i < n; ++i)
    if (t < 1 && std::none_of(pairs, pairs + i, [&](const Pair& p) { return p.to == pairs[i].to; })) {
      wedges_.interpolate(pairs[i].from, pairs[i].to, t, wedges_.at(pairs[i].to));
      if (recording_) recorder_.change_wedge(pairs[i].to, wedges_.at(pairs[i].to));
    }
  for (const Ring::Face& f : from_.face_span()) {
    if (from_.has(f, v)) continue;
    std::uint32_t& wedge = wedges_.of_face[f.face][f.corner];
    auto pair = std::find_if(pairs, pairs + n, [&](const Pair& p) { return p.from == wedge; });
    if (pair == pairs + n) continue;
    if (recording_) recorder_.change_corner(3 * f.face + f.corner, wedge, pair->to);
    wedge = pair->to;
  }
}

/// The faces that go, and without attributes, where a wedge is a vertex, the corners that change theirs.
void Engine::record_corners() {
  for (const Ring::Face& f : from_.face_span())
    if (from_.has(f, to_.center))
      recorder_.remove_face(f.face);
    else if (!wedges_.present())
      recorder_.change_corner(3 * f.face + f.corner, from_.center, to_.center);
}

std::optional<EdgeCollapse> Engine::next() {
  Move move;
  if (!settle(move)) return {};
  return EdgeCollapse{surface_.original(from_.center), surface_.original(to_.center), move.position, move.cost};
}

std::optional<double> Engine::cost(std::uint32_t from, std::uint32_t to) {
  std::uint32_t u = surface_.vertex_of(from), v = surface_.vertex_of(to);
  if (u == none || v == none) return {};
  for (auto [a, b] : {std::pair{u, v}, std::pair{v, u}}) {
    if (a == v && pricer_->one_way()) break;
    if (!surface_.gather(a, ring_)) continue;
    options_.clear();
    pricer_->price(ring_, Pricer::every, options_);
    for (const Option& o : options_)
      if (ring_.spokes[o.spoke].vertex == b) return o.cost;
  }
  return {};
}

}  // namespace wrlkit::simplify
