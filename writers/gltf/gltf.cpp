#include "writers/gltf/gltf.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <filesystem>

#include "base/io/gzip.h"
#include "base/io/output.h"
#include "base/io/same_contents.h"
#include "base/io/uri.h"
#include "base/stop.h"
#include "scenegraph/nodes.h"
#include "writers/gltf/document/dequantize.h"
#include "writers/gltf/document/headlight.h"
#include "writers/gltf/document/hierarchy.h"
#include "writers/gltf/document/move_to_origin.h"
#include "writers/gltf/document/place_tables.h"
#include "writers/gltf/document/round_transforms.h"
#include "writers/gltf/interactivity/interactivity.h"
#include "writers/gltf/json/json.h"
#include "writers/gltf/pointers.h"

namespace wrlkit {
namespace gltf {
namespace {

static_assert(std::endian::native == std::endian::little, "vertex data is written as it lies in memory");

constexpr std::uint64_t glb_limit = std::numeric_limits<std::uint32_t>::max();

bool report_too_large(std::uint64_t bytes, Diagnostics& diag) {
  diag.report(Diag::too_large, {}, "the glTF data", "4 GiB", bytes);
  return false;
}

constexpr double worth_saying = 10'000;  // metres

/// From the nearest point of a box.
double distance_to(const Box& box, const Vec3& p) {
  Vec3 nearest = p;
  for (std::size_t i = 0; i < 3; ++i) nearest[i] = std::clamp(p[i], box.low[i], box.high[i]);
  return length(p - nearest);
}

std::string four_bytes(std::uint64_t v) {
  std::string s;
  for (int i = 0; i < 4; ++i) s += static_cast<char>(v >> 8 * i & 0xff);
  return s;
}

constexpr std::uint64_t chunk_head = 8, glb_head_size = 12 + chunk_head;

/// Up to the JSON.
std::string glb_head(std::uint64_t size, std::uint64_t json) {
  return "glTF" + four_bytes(2) + four_bytes(size) + four_bytes(json) + "JSON";
}
std::string binary_head(std::uint64_t size) { return four_bytes(size) + std::string("BIN\0", 4); }
std::string_view json_padding(std::uint64_t json) { return std::string_view("   ").substr(0, -json % 4); }

/// As part of a file name. A DEF name may have a slash.
std::string without_folders(std::string name) {
  std::ranges::replace_if(
      name, [](char c) { return c == '/' || c == '\\' || (c >= 0 && c < ' '); }, '_');
  return name;
}

/// Files that take their places together, the first one last, because it refers to the others.
class Files {
 public:
  /// `resources`: may be null.
  Files(const Resources* resources, Diagnostics& diag) : resources_(resources), diag_(diag) {}

  /// The file that the output is named after. Where it replaces one, what is next to that goes with it, unreported.
  bool open(const std::filesystem::path& path) {
    std::error_code none;
    is_new_ = !std::filesystem::exists(path, none);
    return add(path, false);
  }
  OutputFile& first() { return files_.front(); }
  bool write(const std::filesystem::path& path, const std::vector<std::string_view>& pieces) {
    if (resources_ && has_contents(path.string(), pieces)) resources_->files_written().add(path.string());
    if (!add(path, is_new_)) return false;
    files_.back().write(pieces);
    return true;
  }
  bool commit() {
    check_stop();
    return std::all_of(files_.rbegin(), files_.rend(), [&](OutputFile& f) { return f.commit(diag_); });
  }

 private:
  bool add(const std::filesystem::path& path, bool report_replaced) {
    const OutputOptions options{.inputs = resources_ ? &resources_->files_read() : nullptr,
                                .written = resources_ ? &resources_->files_written() : nullptr,
                                .report_replaced = report_replaced};
    auto file = OutputFile::open(path.string(), options, diag_);
    if (file) files_.push_back(std::move(*file));
    return file.has_value();
  }

  const Resources* resources_;
  Diagnostics& diag_;
  std::vector<OutputFile> files_;
  bool is_new_ = false;
};

class Writer {
 public:
  Writer(const Scene& scene, const MeshSource& source, const GltfOptions& options, Resources* resources,
         const std::string& path, Diagnostics& diag, GltfSummary* summary = nullptr)
      : scene_(scene),
        options_(options),
        path_(path),
        resources_(resources),
        diag_(diag),
        summary_(summary),
        textures_(scene, resources, options.textures, diag),
        extras_(scene, options.lead_urls, diag),
        animations_(scene, reach(options), options.behaviour == GltfOptions::Behaviour::interactivity, diag),
        materials_(scene, textures_, animations_.motion(), options.extras ? &extras_ : nullptr, options.lightmaps),
        parts_(options.names == GltfOptions::Names::table, options.sources),
        meshes_(scene, source, options.same_mesh, animations_.motion(), store_, parts_, vertex_options(options),
                options.vertices_ahead, diag),
        makers_{scene, options, meshes_, materials_, animations_, options.extras ? &extras_ : nullptr, diag} {}

  bool write() {
    Files files(resources_, diag_);
    if (!files.open(path_)) return false;
    return build([&](Parts& parts) {
      if (!pictures_inside() && !pictures_beside(parts, files)) return false;
      if (!options_.binary) return gltf(parts, files) && files.commit();
      OutputFile& file = files.first();
      const bool written =
          file.can_rewrite() ? glb(parts, file) : glb(parts, [&](auto& pieces) { file.write(pieces); });
      return written && files.commit();
    });
  }

  bool write_glb_to(const Sink& sink) {
    return build([&](Parts& parts) {
      return glb(parts, [&](auto& pieces) {
        for (auto piece : pieces) sink(piece);
      });
    });
  }

 private:
  static Motion::Reach reach(const GltfOptions& o) {
    return !o.animations ? Motion::Reach::nothing : o.animation_pointer ? Motion::Reach::pointers : Motion::Reach::core;
  }

  /// The nodes that show a geometry with morph targets have the weights.
  void add_morphs() {
    std::map<std::uint32_t, std::vector<std::uint32_t>> nodes;
    for (std::uint32_t i = 0; i < document_.nodes.size(); ++i) {
      const Node& n = document_.nodes[i];
      if (n.attachment != Attachment::mesh) continue;
      const auto morph = meshes_.geometries()[meshes_.meshes()[n.attached].geometry].morph;
      if (morph != none) nodes[morph].push_back(i);
    }
    for (auto& [morph, list] : nodes) animations_.add(meshes_.morphs().weights(morph, std::move(list)));
  }

  bool pictures_inside() const {
    return options_.images == GltfOptions::Images::embedded ||
           (options_.images == GltfOptions::Images::automatic && options_.binary);
  }

  /// The nodes, and with them the meshes, materials and pictures that they show.
  void make_document() {
    document_ = build_hierarchy(makers_);
    add_headlight(document_, scene_);
    move_to_origin(document_, options_.origin, [&](NodeId n) { return animations_.moves(n); });
    report_origin();
    if (options_.names == GltfOptions::Names::table)
      make_part_rows(document_, makers_, parts_);
    else if (options_.gpu_instancing)
      make_instances(document_, makers_);
    store_instances(document_, store_);
  }

  void report_origin() {
    if (!document_.origin || !options_.says_origin) return;
    if (options_.origin.kind == GltfOrigin::Kind::given) return report_given_origin();
    const Vec3 moved = Vec3{} - *document_.origin;
    const auto digits = [](double v) { return fmt::format("{:.15g}", v); };  // all of them: --origin takes them
    diag_.report(Diag::moved_to_origin, {}, digits(moved[0]), digits(moved[1]), digits(moved[2]));
  }

  /// Numbers of another unit, or with another axis up, lead away from the scene.
  void report_given_origin() {
    if (document_.world.empty()) return;
    const double far = distance_to(document_.world, *document_.origin), before = distance_to(document_.world, Vec3{});
    if (far > std::max(before, worth_saying))
      diag_.report(Diag::origin_far, {}, options_.origin.print(), fmt::format("{:.6g}", far),
                   fmt::format("{:.6g}", before));
  }

  /// What is left to do with the nodes once it is known how vertices are stored.
  void finish_document(Packing& packing) {
    auto moves = [&](NodeId source) { return animations_.moves(source); };
    if (const double left = packing.tolerance_left(); left > 0)
      packing.note_placement(
          round_transforms(document_, {left, [&](std::uint32_t mesh) { return meshes_.reach(mesh); }, moves}));
    // A Transform can come back only as it is.
    auto keeps = [&](const Node& n) {
      return moves(n.source) || (makers_.keeps_everything() && !(n.source && scene_.is(n.source, nodes::Shape)));
    };
    dequantize(
        document_, [&](std::uint32_t mesh) { return packing.dequantization(meshes_.meshes()[mesh]); }, keeps);
  }

  /// Makes what a file is written from and gives it to `put`.
  bool build(auto&& put) {
    make_document();
    add_morphs();
    add_pointers(animations_, scene_, materials_, document_, diag_);
    animations_.store(store_, [&](std::uint32_t node) { return offset_of(document_, scene_, node); });
    if (store_.full()) return report_too_large(store_.bytes(), diag_);
    static const std::vector<Picture> no_pictures;
    Packing packing(options_.compression, store_, meshes_, document_);
    finish_document(packing);
    const Graph graph = make_interactivity(scene_, document_, animations_, diag_);
    const auto columns = table(packing.uses_meshopt());
    Layout layout(packing.store(), packing.blobs(), columns, pictures_inside() ? textures_.pictures() : no_pictures,
                  packing.uses_meshopt());
    Parts parts{scene_,      document_, meshes_, packing,        materials_,          textures_, layout,
                animations_, graph,     parts_,  makers_.extras, options_.facts_only, {},        {}};
    return put(parts);
  }

  /// In the order in which gltf_json names them.
  std::vector<Column> table(bool packed) const {
    std::vector<Column> out;
    if (!parts_.columns() || parts_.rows().empty()) return out;
    out = {parts_.texts(), parts_.offsets(packed)};
    if (parts_.has_parents()) out.push_back(parts_.parents(packed));
    if (!parts_.sources().empty()) out.push_back(parts_.row_sources());
    return out;
  }

  std::filesystem::path beside(const std::string& name) const {
    return std::filesystem::path(path_).parent_path() / name;
  }
  std::string stem() const { return path_ == "-" ? "world" : std::filesystem::path(path_).stem().string(); }

  bool pictures_beside(Parts& parts, Files& files) {
    std::unordered_map<std::string, int> taken;
    const auto beginning = stem() + (options_.own_folder ? "_files/textures/" : "_");
    for (const auto& picture : textures_.pictures()) {
      const std::string own = without_folders(picture.name);
      std::string name = beginning + own;
      while (taken[name]++ > 0) name = beginning + std::to_string(taken[name]) + "_" + own;
      parts.picture_uris.push_back(uri_of(name));
      if (!files.write(beside(name), {picture.bytes})) return false;
    }
    return true;
  }

  /// `json` holds its bytes only where they are to be packed.
  void summarize(const Parts& parts, std::uint64_t json_size, const Blocks& json,
                 std::vector<GltfSummary::Share> json_shares) const {
    GltfSummary& s = *summary_ = {};
    s.json_shares = std::move(json_shares);
    s.geometry_shares = parts.layout.shares();
    for (auto* shares : {&s.json_shares, &s.geometry_shares})
      std::ranges::stable_sort(*shares, std::greater{}, &GltfSummary::Share::second);
    s.nodes = document_.nodes.size();
    s.meshes = meshes_.meshes().size();
    for (const Node& n : document_.nodes) {
      s.named += n.source && !scene_.name(n.source).empty();
      const Instances* table = n.instances == none ? nullptr : &document_.instances[n.instances];
      if (table && !table->rows.empty())
        s.instances += table->places.size();
      else if (table) {
        s.instances += table->places.size();
        s.named += static_cast<std::size_t>(
            std::ranges::count_if(table->sources, [&](NodeId i) { return !scene_.name(i).empty(); }));
      }
      if (n.attachment != Attachment::mesh) continue;
      ++s.draws;
      const Streams& streams = parts.packing.streams(n.attached);
      const auto& accessors = parts.packing.store().accessors();
      if (meshes_.geometries()[meshes_.meshes()[n.attached].geometry].mode == Mode::triangles)
        s.triangles += accessors[streams.indices == none ? streams.positions : streams.indices].count / 3 *
                       (table ? table->places.size() : 1);
    }
    for (const auto& row : parts_.rows()) s.named += parts_.columns() && !row.name.empty();
    std::vector<std::string_view> text, pictures, geometry;
    json.pieces(text);
    parts.layout.pieces(geometry, false);
    for (const Picture& p : textures_.pictures()) {
      pictures.push_back(p.bytes);
      s.pictures += p.bytes.size();
    }
    s.json = json_size;
    s.geometry = parts.layout.geometry_size();
    s.quantization = parts.packing.quantization();
    s.recoding = textures_.recoding();
    if (options_.measure_gzip) {
      s.json_gzip = gzipped_size(text);
      s.geometry_gzip = gzipped_size(geometry);
      s.pictures_gzip = gzipped_size(pictures);
    }
  }

  /// Null: too large, which is reported.
  std::optional<std::uint64_t> glb_size(const Parts& parts, std::uint64_t json) const {
    const std::uint64_t binary = parts.layout.size();
    const std::uint64_t size = glb_head_size + json + (binary > 0 ? chunk_head + binary : 0);
    if (size <= glb_limit) return size;
    report_too_large(size, diag_);
    return std::nullopt;
  }

  /// For what can only be written in order: the JSON is kept until its size is known.
  bool glb(const Parts& parts, auto&& put) {
    Blocks json;
    write_json_to(parts, [&](std::string_view s) { json.append(s); });
    json.append(json_padding(json.size()));
    const auto size = glb_size(parts, json.size());
    if (!size) return false;
    const std::string start = glb_head(*size, json.size()), between = binary_head(parts.layout.size());
    std::vector<std::string_view> pieces{start};
    json.pieces(pieces);
    if (parts.layout.size() > 0) pieces.push_back(between);
    parts.layout.pieces(pieces);
    put(pieces);
    return true;
  }

  bool glb(const Parts& parts, OutputFile& file) {
    file.write(std::string(glb_head_size, '\0'));
    auto json = write_json_to(parts, file.sink());
    const auto padding = json_padding(json);
    json += padding.size();
    const auto size = glb_size(parts, json);
    if (!size) return false;
    const std::string between = binary_head(parts.layout.size());
    std::vector<std::string_view> pieces{padding};
    if (parts.layout.size() > 0) pieces.push_back(between);
    parts.layout.pieces(pieces);
    file.write(pieces);
    file.rewrite(0, glb_head(*size, json));
    return true;
  }

  bool gltf(Parts& parts, Files& files) {
    if (parts.layout.size() > 0) {
      auto name = stem() + ".bin";
      parts.buffer_uri = uri_of(name);
      std::vector<std::string_view> pieces;
      parts.layout.pieces(pieces);
      if (!files.write(beside(name), pieces)) return false;
    }
    write_json_to(parts, files.first().sink());
    files.first().write("\n");
    return true;
  }

  /// How many bytes it was.
  std::uint64_t write_json_to(const Parts& parts, const Sink& sink) const {
    const bool keeps = summary_ && options_.measure_gzip;
    Blocks kept;
    std::uint64_t size = 0;
    auto shares = write_json(parts, [&](std::string_view s) {
      size += s.size();
      if (keeps) kept.append(s);
      sink(s);
    });
    if (summary_) summarize(parts, size, kept, std::move(shares));
    return size;
  }

  const Scene& scene_;
  const GltfOptions& options_;
  std::string path_;
  const Resources* resources_;
  Diagnostics& diag_;
  GltfSummary* summary_;
  Textures textures_;
  Extras extras_;
  Store store_;
  Animations animations_;
  Materials materials_;
  PartTable parts_;
  Meshes meshes_;
  Makers makers_;
  Document document_;
};

}  // namespace

VertexOptions vertex_options(const GltfOptions& o) {
  return {.lightcoords = o.lightmaps != GltfOptions::Lightmaps::base_color,
          .ordered = o.compression.method == GltfCompression::Method::meshopt};
}

}  // namespace gltf

bool write_gltf(const Scene& scene, const MeshSource& source, const GltfOptions& options, Resources* resources,
                const std::string& path, Diagnostics& diag, GltfSummary* summary) {
  return gltf::Writer(scene, source, options, resources, path, diag, summary).write();
}

bool write_glb(const Scene& scene, const MeshSource& source, const GltfOptions& options, Resources* resources,
               const Sink& sink, Diagnostics& diag) {
  GltfOptions whole = options;
  whole.binary = true;
  whole.images = GltfOptions::Images::embedded;
  return gltf::Writer(scene, source, whole, resources, {}, diag).write_glb_to(sink);
}

}  // namespace wrlkit
