#include "writers/gltf/json/lists.h"

#include "writers/gltf/json/part.h"

namespace wrlkit::gltf {
namespace {

class AssetJson : public JsonPart {
 public:
  using JsonPart::JsonPart;

  void asset() {
    const auto& parts = p_.names.rows();
    const bool listed = !p_.names.columns() && !parts.empty();
    json_.object("asset", [&] {
      json_.members("version", "2.0", "generator", "wrlkit");
      if (!p_.extras && !listed) return;
      json_.object("extras", [&] {
        if (listed) list("features", parts.size(), [&](std::size_t i) { json_.value(parts[i].name); });
        if (p_.extras) json_.object("vrml97", [&] { said_of_file(); });
      });
    });
  }

  void extensions() {
    if (d_.lights.empty() && p_.graph.empty() && !p_.has_table()) return;
    json_.object("extensions", [&] {
      if (p_.has_table()) table();
      if (!p_.graph.empty()) json_.object("KHR_interactivity", [&] { p_.graph.write(json_); });
      if (!d_.lights.empty()) {
        json_.object("KHR_lights_punctual", [&] {
          list("lights", d_.lights.size(),
               [&](std::size_t i) { write_light(json_, p_.scene, d_.lights[i], d_.world); });
        });
      }
    });
  }

 private:
  void said_of_file() {
    if (p_.facts_only) json_.member("facts", true);
    if (!p_.scene.comment.empty()) json_.member("comment", p_.scene.comment);
    const auto& meta = p_.scene.x3d.meta;
    list("meta", meta.size(), [&](std::size_t i) {
      json_.begin_array();
      json_.values(meta[i].first, meta[i].second);
      json_.end_array();
    });
    if (d_.world_info) p_.extras->node(json_, d_.world_info, {});
  }

  void source_names() {
    const auto value = [&](std::string_view name, std::size_t number) {
      json_.value(json_object("name", name, "value", number));
    };
    const auto& names = p_.names.sources();
    json_.object("enums", [&] {
      json_.object("source", [&] {
        json_.key("values");
        json_.begin_array();
        for (std::size_t i = 0; i < names.size(); ++i) value(names[i], i);
        if (p_.names.any_without_source()) value("", PartTable::no_source);
        json_.end_array();
      });
    });
  }

  /// EXT_structural_metadata: a row for each part and group.
  void table() {
    const bool packed = p_.packing.uses_meshopt(), parents = p_.names.has_parents();
    const std::size_t n = p_.names.rows().size();
    const auto no_parent = PartTable::no_parent(packed, n);
    const bool sources = !p_.names.sources().empty();
    auto schema = [&] {
      json_.member("id", "parts");
      json_.object("classes", [&] {
        json_.object("part", [&] {
          json_.object("properties", [&] {
            json_.member("name", JsonText{R"({"type":"STRING","semantic":"NAME","required":true})"});
            if (parents)
              json_.object("parent", [&] {
                json_.members("type", "SCALAR", "componentType", no_parent == none ? "UINT32" : "UINT16", "noData",
                              no_parent);
                // 3d-tiles-renderer takes 0 for no data where there is no default.
                if (!p_.extras) json_.member("default", no_parent);
              });
            if (sources)
              json_.object("source", [&] {
                json_.member("type", "ENUM");
                json_.member("enumType", "source");
                if (p_.names.any_without_source()) json_.member("noData", "");
              });
          });
        });
      });
      if (sources) source_names();
    };
    auto columns = [&] {
      json_.object("name", [&] {
        json_.members("values", p_.layout.of_column(0), "stringOffsets", p_.layout.of_column(1));
        if (p_.layout.stride_of_column(1) != 4) json_.member("stringOffsetType", "UINT16");
      });
      if (parents) json_.object("parent", [&] { json_.member("values", p_.layout.of_column(2)); });
      if (sources) json_.object("source", [&] { json_.member("values", p_.layout.of_column(parents ? 3 : 2)); });
    };
    json_.object("EXT_structural_metadata", [&] {
      json_.object("schema", schema);
      list("propertyTables", 1, [&](std::size_t) {
        json_.object([&] {
          json_.members("class", "part", "count", n);
          json_.object("properties", columns);
        });
      });
    });
  }
};

}  // namespace

void write_asset(JsonOut& json, const Parts& parts) { AssetJson(json, parts).asset(); }

void write_extensions(JsonOut& json, const Parts& parts) { AssetJson(json, parts).extensions(); }

}  // namespace wrlkit::gltf
