// Limits that only very large worlds reach.
#include <catch2/catch.hpp>

#include "light/render/gather.h"
#include "scenegraph/nodes.h"
#include "tests/unit/test_world.h"
#include "writers/gltf/store.h"

using namespace wrlkit;

TEST_CASE("limits: what is drawn beyond 40 million elements is dropped and reported", "[hostile]") {
  TestWorld world("Shape { geometry PointSet { } } Shape { geometry PointSet { } } Shape { geometry PointSet { } }");
  Mesh mesh;
  mesh.kind = Mesh::Kind::points;
  mesh.positions.edit() = {1, 2, 3};
  mesh.corners.assign(25'000'000, 0);
  mesh.face_begin = {0, 25'000'000};
  const MeshSource source = [&](NodeId) -> const Mesh& { return mesh; };
  drawing::Stage stage = drawing::set_stage(world.scene, world.diag);
  REQUIRE(stage.uses.size() == 3);
  drawing::MeshPool pool;
  const auto meshes = drawing::Gatherer(world.scene, source, pool).meshes_of(stage, world.diag);
  CHECK(pool[meshes[1]].n_elements == 25'000'000);
  CHECK(pool[meshes[2]].n_elements == 0);
  CHECK(pool.n_elements() == 50'000'000);
  REQUIRE(world.diag.count() == 1);
  CHECK(world.diag.messages()[0].id == Diag::expansion_limit);
}

TEST_CASE("limits: a .glb takes so many bytes and no more", "[gltf]") {
  gltf::Store store(5 << 20);
  std::string bytes(1 << 20, '\0');
  for (char i = 0; i < 5; ++i) {
    bytes[0] = i;  // no two are equal: those would be stored once
    CHECK(store.raw(gltf::View::time, bytes) != gltf::none);
  }
  CHECK_FALSE(store.full());
  bytes[0] = 5;
  CHECK(store.raw(gltf::View::time, bytes) == gltf::none);
  CHECK(store.full());
  CHECK(store.bytes() == 5 * bytes.size());
  bytes[0] = 4;
  CHECK(store.raw(gltf::View::time, bytes) != gltf::none);  // is there already
}
