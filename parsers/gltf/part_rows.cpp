#include "parsers/gltf/part_rows.h"

#include <algorithm>

#include "scenegraph/places/name_path.h"

namespace wrlkit::gltf_reader {
namespace {

constexpr double largest_id = 16777216;   // ids are stored as floats
constexpr std::size_t most_groups = 200;  // in one another; what is deeper stands by itself

}  // namespace

const std::vector<PartRow>& PartRows::rows() {
  if (read_) return rows_;
  read_ = true;
  const auto tables = c_.file.root()["extensions"]["EXT_structural_metadata"]["propertyTables"].elements();
  if (!tables.empty())
    read_table(tables[0]);
  else
    read_paths(c_.file.root()["asset"]["extras"]["features"]);
  made_.resize(rows_.size());
  return rows_;
}

/// Numbers of a buffer view: at least n of them.
std::optional<std::vector<std::uint64_t>> PartRows::column(Json view, std::string_view type, std::size_t n) {
  const std::size_t size = type == "UINT8" ? 1 : type == "UINT16" ? 2 : type == "UINT64" ? 8 : 4;
  const auto index = c_.file.index(Table::bufferViews, view);
  const auto bytes = index == none ? std::nullopt : c_.buffers.view(index);
  if (!bytes || bytes->bytes.size() / size < n) {
    c_.diag().report(Diag::gltf_outside, c_.file.where(view), "EXT_structural_metadata", "its bufferView");
    return std::nullopt;
  }
  std::vector<std::uint64_t> out(n);
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t k = 0; k < size; ++k)
      out[i] |= std::uint64_t{static_cast<unsigned char>(bytes->bytes[i * size + k])} << 8 * k;
  return out;
}

void PartRows::read_table(Json table) {
  const Json name = table["properties"]["name"], parent = table["properties"]["parent"];
  const auto index = c_.file.index(Table::bufferViews, name["values"]);
  const auto texts = index == none ? std::nullopt : c_.buffers.view(index);
  const auto n = table["count"].whole().value_or(0);
  if (!texts || n >= largest_id) return;
  const auto offsets = column(name["stringOffsets"], name["stringOffsetType"].text("UINT32"), n + 1);
  if (!offsets) return;
  const Json classes = c_.file.root()["extensions"]["EXT_structural_metadata"]["schema"]["classes"];
  const auto parents =
      parent
          ? column(parent["values"], classes[table["class"].text()]["properties"]["parent"]["componentType"].text(), n)
          : std::nullopt;
  std::vector<std::size_t> depth(n);
  for (std::size_t i = 0; i < n; ++i) {
    const auto from = (*offsets)[i], to = (*offsets)[i + 1];
    if (from > to || to > texts->bytes.size()) {
      rows_.clear();
      return c_.diag().report(Diag::gltf_bad_value, c_.file.where(name), "EXT_structural_metadata: stringOffsets");
    }
    const bool below = parents && (*parents)[i] < i && depth[(*parents)[i]] < most_groups;
    if (below) depth[i] = depth[(*parents)[i]] + 1;
    rows_.push_back(
        {std::string(texts->bytes.substr(from, to - from)), below ? static_cast<std::uint32_t>((*parents)[i]) : none});
  }
}

/// "Unit/Pump" is Pump in Unit. Rows of groups stand behind those of the list: its order is that of the ids.
void PartRows::read_paths(Json list) {
  const auto all = list.elements();
  std::map<std::string_view, std::uint32_t> groups;
  rows_.resize(all.size());
  for (std::size_t i = 0; i < all.size(); ++i) groups.try_emplace(all[i].text(), static_cast<std::uint32_t>(i));
  for (std::size_t i = 0; i < all.size(); ++i) {
    std::string_view path = all[i].text();
    std::uint32_t row = static_cast<std::uint32_t>(i);
    const bool whole = static_cast<std::size_t>(std::ranges::count(path, '/')) > most_groups;
    for (;;) {
      const auto slash = whole ? path.npos : path.rfind('/');
      rows_[row].name = name_of_step(path.substr(slash == path.npos ? 0 : slash + 1));
      if (slash == path.npos) break;
      path = path.substr(0, slash);
      const auto [at, is_new] = groups.try_emplace(path, static_cast<std::uint32_t>(rows_.size()));
      if (is_new) rows_.emplace_back();
      rows_[row].parent = at->second;
      if (!is_new) break;
      row = at->second;
    }
  }
}

std::vector<std::uint32_t> PartRows::ids(Json set, Json attributes) {
  const auto number = set["attribute"].whole();
  const auto index =
      number ? c_.file.index(Table::accessors, attributes["_FEATURE_ID_" + std::to_string(*number)]) : none;
  const auto values = index == none ? std::nullopt : c_.accessors.numbers(index, {1});
  return values ? ids(set, values->values) : std::vector<std::uint32_t>();
}

std::vector<std::uint32_t> PartRows::ids(Json set, const std::vector<double>& values) {
  std::vector<std::uint32_t> out;
  const double nothing = set["nullFeatureId"].number(-1);
  for (double id : values) {
    if (!(id >= 0 && id < largest_id)) {
      c_.diag().report(Diag::gltf_bad_value, c_.file.where(set), "_FEATURE_ID_0");
      return std::vector<std::uint32_t>();
    }
    out.push_back(id == nothing ? none : static_cast<std::uint32_t>(id));
  }
  return out;
}

bool PartRows::is_group(std::uint32_t row) {
  if (!counted_) count();
  return row < times_.size() && times_[row] > 1;
}

void PartRows::count() {
  counted_ = true;
  times_.assign(rows().size(), 0);
  auto add = [&](std::uint32_t row, int n) {
    if (row < times_.size()) times_[row] = static_cast<std::uint8_t>(std::min(2, times_[row] + n));
  };
  for (const PartRow& r : rows_) add(r.parent, 2);
  for (std::uint32_t n = 0; n < c_.file.count(Table::nodes); ++n) {
    const Json e = c_.file.at(Table::nodes, n)["extensions"];
    for (Json set : e["EXT_instance_features"]["featureIds"].elements())
      for (auto row : ids(set, e["EXT_mesh_gpu_instancing"]["attributes"])) add(row, 1);
  }
  for (std::uint32_t m = 0; m < c_.file.count(Table::meshes); ++m)
    for (Json p : c_.file.at(Table::meshes, m)["primitives"].elements()) {
      if (p["extensions"]["KHR_draco_mesh_compression"])
        continue;  // a part that is also placed once has its name twice then
      for (Json set : p["extensions"]["EXT_mesh_features"]["featureIds"].elements()) {
        auto all = ids(set, p["attributes"]);
        std::ranges::sort(all);
        all.erase(std::unique(all.begin(), all.end()), all.end());
        for (auto row : all) add(row, 2);
      }
    }
}

}  // namespace wrlkit::gltf_reader
