// Pages of colour and light, packed again: each chart has as many texels as what it shows needs.
#pragma once
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "geometry/unwrap/pack.h"
#include "passes/combine_lightmap/chart_image.h"
#include "passes/combine_lightmap/light_charts.h"
#include "passes/combine_lightmap/needs.h"
#include "scenegraph/ids.h"

namespace wrlkit::combine {

struct RepackOptions {
  int scale = 0;         // texels for each texel of the light, along each side; 0: as many as the texture has
  int max_size = 4096;   // of a page
  double tolerance = 0;  // by which even charts may change to have fewer texels, in 255ths
  bool all = false;      // errors of all halvings are wanted, for a budget
  bool alpha = false;
};

class Repacking {
 public:
  /// A Shape with light.
  struct Item {
    NodeId geometry;
    const drawing::Surface* surface;
  };
  using MeshOf = std::function<Mesh(NodeId geometry, bool textured)>;

  Repacking(std::span<const Item> shapes, const MeshOf& mesh_of, const RepackOptions& options);

  /// Looks at all charts. False when there are numbers that cannot be reckoned with: nothing else may be called then.
  /// O(texels).
  bool measure();
  std::span<ChartNeed> needs() { return needs_; }
  /// Between charts: as much as costs little.
  int padding() const;

  void pack();
  const std::vector<unwrap::Page>& pages() const { return atlas_.pages; }
  std::uint64_t texels() const;
  Image paint(std::uint32_t page) const;

  // What is written of it.
  std::size_t n_geometries() const { return geometries_.size(); }
  NodeId geometry(std::size_t g) const { return geometries_[g].node; }
  std::span<const std::uint32_t> shapes(std::size_t g) const { return geometries_[g].shapes; }
  /// Texture coordinates, by place of the light.
  std::vector<double> places(std::size_t g) const;
  std::uint32_t page(std::size_t g, std::size_t k) const;
  /// Of the coordinates for Shape k of a geometry; nothing: they are its own.
  std::optional<TexcoordMap> transform(std::size_t g, std::size_t k) const;

 private:
  struct Geometry {
    NodeId node;
    std::vector<std::uint32_t> shapes;
    Mesh mesh;
    TexcoordMap to_texels;  // of the light, from its places
    LightCharts light;
    std::size_t first_need = 0;
    std::vector<std::vector<ChartImage>> images;  // by Shape and chart: halved once, twice ...
  };
  struct Job {
    std::size_t geometry, chart;
  };

  bool make_charts(Geometry& g);
  void find_scale(const Geometry& g, std::uint32_t chart);
  void find_errors(Geometry& g, std::uint32_t chart);
  std::vector<ChartImage> halved(const Geometry& g, std::size_t k, std::uint32_t chart,
                                 std::vector<Difference>& errors) const;
  const ChartNeed& need(const Geometry& g, std::uint32_t chart) const { return needs_[g.first_need + chart]; }
  TexcoordMap light_of(const Geometry& g, std::size_t k) const;
  TexcoordMap chart_map(std::size_t g, std::uint32_t chart) const;
  double unit(std::size_t g) const;
  void list(std::size_t g, std::size_t k, std::uint32_t page, std::vector<PageTriangle>& triangles,
            std::vector<Painted>& painted) const;

  std::span<const Item> shapes_;
  RepackOptions options_;
  std::vector<Geometry> geometries_;
  std::vector<ChartNeed> needs_;
  unwrap::Atlas atlas_;
};

}  // namespace wrlkit::combine
