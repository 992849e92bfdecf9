// Meshes that other threads make before the writer asks for them. Nobody hears what is said of those: where anything
// is, the mesh is made again when it is asked for, so that messages come in their order.
#pragma once
#include <atomic>
#include <deque>
#include <memory>
#include <mutex>
#include <span>
#include <unordered_map>
#include <vector>

#include "base/background.h"
#include "base/task.h"
#include "geometry/mesh.h"
#include "geometry/vertices.h"
#include "passes/pipeline/pipeline.h"

namespace wrlkit {

/// Fills vertices with what a writer makes of the mesh of a geometry that is shown with a texture or without.
using VertexMaker = std::function<void(NodeId, const Mesh&, bool textured, SplitScratch&, Vertices& out)>;

class MeshesAhead {
 public:
  struct Known {
    std::uint64_t hash = 0;  // EqualGeometry::hash_of
    NodeId same;             // one before it that says the same; then there is no mesh
    bool done = false;       // the mesh is here, and nothing was said of it
    Mesh mesh;
    Vertices vertices;  // of the mesh; empty without a maker
    Statistics counted;
  };

  MeshesAhead(const Scene& scene, const MeshMakers& makers, const VertexMaker& vertices = nullptr);
  ~MeshesAhead();

  /// Begins with the first of these geometries; `textured` by node. Does nothing where there is too little to do, or
  /// one thread only.
  void begin(std::span<const NodeId> geometries, std::span<const char> textured);
  /// What is known of one, when it is; threads go on to those behind it, and what is before it is forgotten. Null:
  /// nothing is known. Good until the next call.
  Known* find(NodeId);

 private:
  /// What one thread does at once.
  struct Batch {
    std::vector<NodeId> geometries;
    std::size_t n_indices = 0;
    std::vector<Known> known;  // the same order
    std::atomic<bool> claimed = false;
    bool ready = false;
    std::unique_ptr<Background> thread;
  };
  /// What passes need that work on one thread.
  struct Worker {
    explicit Worker(const MeshMakers& makers) : make(makers(task)) {}

    Diagnostics unheard;
    Statistics counted;
    Task task{unheard, counted};
    MeshMaker make;
    SplitScratch scratch;
  };

  void add(NodeId);
  void begin_more();
  bool make(Batch&);
  void make(NodeId, Known&, Worker&);
  NodeId first_like(NodeId, std::uint64_t key);
  std::unique_ptr<Worker> take_worker();
  void give_back(std::unique_ptr<Worker>);

  const Scene& scene_;
  const MeshMakers& makers_;
  const VertexMaker vertices_;
  std::span<const char> textured_;
  std::vector<std::uint32_t> batch_of_;  // by node
  std::deque<Batch> batches_;
  std::size_t now_ = 0, next_ = 0;  // what is asked for; the first that was not begun
  std::size_t n_begun_ = 0;         // indices of those between
  std::atomic<bool> given_up_ = false;
  std::mutex mutex_;
  std::unordered_map<std::uint64_t, NodeId> first_;  // by hash; none: every one like it is made
  std::vector<std::unique_ptr<Worker>> idle_;
};

}  // namespace wrlkit
