#include "convert/meshes_ahead.h"

#include <algorithm>

#include "base/hashing.h"
#include "base/parallel.h"
#include "geometry/equal_geometry.h"
#include "scenegraph/nodes.h"

namespace wrlkit {
namespace {

constexpr std::uint32_t none = 0xffffffff;
constexpr std::size_t per_batch = 8 * 1024, per_scene = 128 * 1024;  // indices that are worth a thread
constexpr std::size_t most_begun = 8 * per_batch;                    // bounds the memory
constexpr std::size_t per_node = 64;                                 // what a node costs in addition, in indices

std::size_t n_indices(const Scene& scene, NodeId n) {
  if (scene.is(n, nodes::IndexedFaceSet)) return scene.get(n, nodes::indexed_face_set::coordIndex).size();
  if (scene.is(n, nodes::IndexedLineSet)) return scene.get(n, nodes::indexed_line_set::coordIndex).size();
  return 0;
}

}  // namespace

MeshesAhead::MeshesAhead(const Scene& scene, const MeshMakers& makers, const VertexMaker& vertices)
    : scene_(scene), makers_(makers), vertices_(vertices) {}

MeshesAhead::~MeshesAhead() {
  given_up_ = true;
  for (Batch& batch : batches_) batch.thread.reset();  // before what they use
}

void MeshesAhead::begin(std::span<const NodeId> geometries, std::span<const char> textured) {
  if (!makers_ || only_one_thread()) return;
  std::size_t all = 0;
  for (const NodeId n : geometries) all += n_indices(scene_, n);
  if (all < per_scene) return;
  textured_ = textured;
  batch_of_.assign(scene_.node_count(), none);
  for (const NodeId n : geometries)
    if (n_indices(scene_, n) > 0) add(n);
  begin_more();
}

void MeshesAhead::add(NodeId n) {
  if (batches_.empty() || batches_.back().n_indices >= per_batch) batches_.emplace_back();
  auto& last = batches_.back();
  batch_of_[n.value] = static_cast<std::uint32_t>(batches_.size() - 1);
  last.geometries.push_back(n);
  last.n_indices += n_indices(scene_, n) + per_node;
}

/// There is always one to be made behind that at hand, however large.
void MeshesAhead::begin_more() {
  for (; next_ < batches_.size() && (next_ <= now_ + 1 || n_begun_ < most_begun); ++next_) {
    Batch& batch = batches_[next_];
    n_begun_ += batch.n_indices;
    batch.thread = std::make_unique<Background>();
    batch.thread->run([this, &batch] { make(batch); });
  }
}

MeshesAhead::Known* MeshesAhead::find(NodeId n) {
  const auto of = n.value < batch_of_.size() ? batch_of_[n.value] : none;
  if (of == none || of < now_) return nullptr;
  for (; now_ < of; ++now_) {
    Batch& past = batches_[now_];
    if (now_ < next_) n_begun_ -= past.n_indices;
    // Waiting for what was begun would have this thread make meshes that others are there for.
    if (past.claimed.exchange(true) && !past.ready) past.thread->wait();
    past.known = std::vector<Known>();  // gives the memory back
  }
  next_ = std::max(next_, now_);
  begin_more();
  Batch& batch = batches_[now_];
  if (!batch.ready && !make(batch)) batch.thread->wait();
  batch.ready = true;
  const auto at = std::ranges::find(batch.geometries, n);
  return &batch.known[static_cast<std::size_t>(at - batch.geometries.begin())];
}

/// False: another thread has begun with it.
bool MeshesAhead::make(Batch& batch) {
  if (batch.claimed.exchange(true)) return false;
  batch.known.resize(batch.geometries.size());
  auto worker = take_worker();
  for (std::size_t i = 0; i < batch.geometries.size() && !given_up_; ++i)
    make(batch.geometries[i], batch.known[i], *worker);
  give_back(std::move(worker));
  return true;
}

void MeshesAhead::make(NodeId n, Known& known, Worker& worker) {
  known.hash = EqualGeometry::hash_of(scene_, n);
  const auto key = mixed(known.hash, static_cast<std::uint64_t>(textured_[n.value]));
  if (known.hash != 0) {
    const NodeId first = first_like(n, key);
    if (first && first != n && EqualGeometry::same(scene_, first, n)) {
      known.same = first;
      return;
    }
  }
  try {
    worker.make(n, known.mesh);
    known.done = worker.unheard.messages().empty();
    if (known.done && vertices_) vertices_(n, known.mesh, textured_[n.value] != 0, worker.scratch, known.vertices);
  } catch (...) {  // it will be thrown again where it can be caught
    known.done = false;
  }
  known.counted = std::exchange(worker.counted, {});
  if (known.done && known.counted.empty()) return;
  if (!worker.unheard.messages().empty()) worker.unheard = Diagnostics();
  if (known.hash == 0) return;
  const std::scoped_lock lock(mutex_);
  first_[key] = NodeId{};
}

/// The first with that hash, which is this one from now on where there is none.
NodeId MeshesAhead::first_like(NodeId n, std::uint64_t key) {
  const std::scoped_lock lock(mutex_);
  return first_.emplace(key, n).first->second;
}

std::unique_ptr<MeshesAhead::Worker> MeshesAhead::take_worker() {
  const std::scoped_lock lock(mutex_);
  if (idle_.empty()) return std::make_unique<Worker>(makers_);
  auto worker = std::move(idle_.back());
  idle_.pop_back();
  return worker;
}

void MeshesAhead::give_back(std::unique_ptr<Worker> worker) {
  const std::scoped_lock lock(mutex_);
  idle_.push_back(std::move(worker));
}

}  // namespace wrlkit
