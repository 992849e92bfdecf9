// The Python module wrlkit._wrlkit: worlds, their nodes with the fields of the node table as attributes, meshes and
// arrays of numbers as NumPy arrays that are the scene's own memory, passes by the text of a pipeline, conversions as
// the command line does them.
#include <pybind11/stl/filesystem.h>

#include <algorithm>
#include <filesystem>

#include "base/text/nearest_name.h"
#include "geometry/geometry.h"
#include "python/world.h"
#include "scenegraph/nodes.h"
#include "scenegraph/walk.h"

namespace wrlkit::python {
namespace {

namespace fs = std::filesystem;

/// What a geometry node shows, as passes see it.
struct PyMesh {
  std::shared_ptr<PyWorld> world;
  Mesh mesh;
};

PyMesh mesh_of(const PyNode& node) {
  if (!node.type().is_a(nodes::X3DGeometryNode))
    throw type_error(std::string(node.type().name) + " is not a geometry node");
  return {node.world, node.world->mesh(node.id)};
}

NearestName nearest_type(std::string_view name) {
  NearestName nearest(name);
  for (const auto& type : builtin_nodes()) nearest.consider(type.name);
  return nearest;
}

/// Raises when neither the node table nor the world has a type of that name.
void check_type(const Scene& scene, const std::string& name) {
  const auto is_it = [&](const NodeType& type) { return type.is_named(name); };
  if (name.empty() || std::ranges::any_of(builtin_nodes(), is_it) || std::ranges::any_of(scene.own_types(), is_it))
    return;
  NearestName nearest = nearest_type(name);
  for (const auto& type : scene.own_types()) nearest.consider(type.name);
  throw value_error("there is no node type '" + name + "'" + nearest.question());
}

std::vector<PyNode> nodes_of(const std::shared_ptr<PyWorld>& world, const Text& type) {
  check_type(world->scene(), type.bytes);
  std::vector<PyNode> out;
  for (NodeId n : reachable(world->scene(), world->scene().main))
    if (type.bytes.empty() || world->scene().type(n).is_named(type.bytes)) out.push_back({world, n});
  return out;
}

Reading reading_of(const std::vector<fs::path>& allow, const Text& unit, const Text& up) {
  return {{allow.begin(), allow.end()}, unit.bytes, up.bytes};
}

std::shared_ptr<PyWorld> load(const fs::path& path, const std::vector<fs::path>& allow, const Text& unit,
                              const Text& up) {
  return PyWorld::load(path.string(), reading_of(allow, unit, up));
}

std::shared_ptr<PyWorld> load_bytes(const py::bytes& data, const Text& name, const std::vector<fs::path>& allow,
                                    const Text& unit, const Text& up) {
  return PyWorld::load_bytes(data, name.bytes, reading_of(allow, unit, up));
}

std::vector<MessageView> convert_paths(const fs::path& source, const fs::path& target, const fs::path& recipe,
                                       const std::optional<Text>& pipeline, const py::kwargs& options) {
  return convert(source.string(), target.string(), recipe.string(),
                 pipeline ? std::optional(pipeline->bytes) : std::nullopt, options);
}

py::object find_node(const std::shared_ptr<PyWorld>& world, const Text& name) {
  for (NodeId n : reachable(world->scene(), world->scene().main))
    if (!name.bytes.empty() && world->scene().name(n) == name.bytes) return py::cast(PyNode{world, n});
  return py::none();
}

std::vector<Text> fields_of(const PyNode& n) {
  std::vector<Text> names;
  for (const auto& f : n.type().fields)
    if (f.has_value()) names.push_back({std::string(f.name_in(Dialect::vrml97))});
  return names;
}

PyNode add_node(const std::shared_ptr<PyWorld>& w, const Text& type, const py::kwargs& fields) {
  auto id = find_builtin(type.bytes, Dialect::vrml97);
  if (!id) id = find_builtin(type.bytes, Dialect::x3d);
  if (!id) throw value_error("there is no node type '" + type.bytes + "'" + nearest_type(type.bytes).question());
  PyNode node{w, w->scene().add(id)};
  for (const auto& [name, value] : fields)
    set_field(node, name.cast<Text>(), py::reinterpret_borrow<py::object>(value));
  return node;
}

FixedNodes roots_of(const std::shared_ptr<PyWorld>& w) {
  py::list out;
  for (NodeId n : w->scene().main.roots) out.append(PyNode{w, n});
  return fixed_list(out, "World.roots");
}

void set_roots(const std::shared_ptr<PyWorld>& w, const py::object& nodes) {
  const auto wrong = [](const py::object& given) {
    return type_error("World.roots is a list of Nodes, not " + shown_value(given));
  };
  if (py::isinstance<PyNode>(nodes) || !py::isinstance<py::iterable>(nodes)) throw wrong(nodes);
  std::vector<NodeId> ids;
  for (const auto item : nodes) {
    if (!py::isinstance<PyNode>(item)) throw wrong(py::reinterpret_borrow<py::object>(item));
    const auto& n = item.cast<const PyNode&>();
    ids.push_back(n.world == w ? n.id : throw value_error("the node is of another world"));
  }
  w->scene().main.roots = ids;
}

std::vector<Text> pass_names() {
  std::vector<Text> names;
  for (const auto& p : passes()) names.push_back({std::string(p.name)});
  for (const auto* p : added_passes()) names.push_back({std::string(p->name)});
  return names;
}

/// Every node type that a world of VRML97 or X3D may have: what it is for, and its fields with their types.
std::map<std::string, std::pair<std::string, std::vector<std::pair<std::string, std::string>>>> node_types() {
  std::map<std::string, std::pair<std::string, std::vector<std::pair<std::string, std::string>>>> out;
  for (const auto& t : builtin_nodes()) {
    if (!find_builtin(t.name, Dialect::vrml97) && !find_builtin(t.name, Dialect::x3d)) continue;
    auto& [doc, fields] = out[std::string(t.name)];
    doc = t.doc;
    fields.clear();
    for (const auto& f : t.fields)
      if (f.has_value()) fields.emplace_back(f.name_in(Dialect::vrml97), info(f.type).name);
  }
  return out;
}

/// Why what a Node has besides fields cannot be set.
std::string read_only(const PyNode& node, const std::string& name) {
  auto why = "Node." + name + " cannot be set";
  const auto fields = fields_of(node);
  if (std::ranges::find(fields, name, &Text::bytes) != fields.end())
    why += "; the field of that name is node['" + name + "']";
  return why;
}

void set_attribute(const py::object& self, const Text& name, const py::object& value) {
  const auto& node = self.cast<const PyNode&>();
  if (name.bytes == "name" && !py::isinstance<py::str>(value))
    throw type_error("Node.name is a str, not " + shown_value(value));
  if (name.bytes == "type" || name.bytes == "world" || name.bytes == "fields")
    throw attribute_error(read_only(node, name.bytes));
  if (name.bytes == "name")
    self.get_type().attr("name").attr("__set__")(self, value);
  else
    set_field(node, name, value);
}

/// A node of its own with the same fields, which is nowhere yet, without the name.
PyNode copied(const PyNode& node) {
  Scene& scene = node.scene();
  const auto fields = scene.copy_of_fields(node.id);
  const NodeId made = scene.add(scene.type_id(node.id), scene.where(node.id));
  scene.set_fields(made, fields);
  return {node.world, made};
}

/// For classes whose objects cannot be copied, or cannot leave the process.
template <class T, class... Holder>
void not_copied(py::class_<T, Holder...>& type, std::initializer_list<const char*> methods, const char* why) {
  for (const auto* method : methods)
    type.def(method, [why](const py::object&, const py::args&) -> py::object { throw type_error(why); });
}

/// For classes whose objects only wrlkit makes.
template <class T, class... Holder>
void no_constructor(py::class_<T, Holder...>& type, const char* why) {
  type.def(py::init([why](const py::args&, const py::kwargs&) -> T* { throw type_error(why); }), why);
}

void define_message(py::class_<MessageView>& type) {
  const auto pickled = [](const MessageView& m) {
    return py::make_tuple(static_cast<int>(m.severity), text_value(m.name), text_value(m.text), text_value(m.file),
                          m.line, m.column);
  };
  const auto unpickled = [](const py::tuple& t) {
    return MessageView{static_cast<Severity>(t[0].cast<int>()),
                       bytes_of(t[1]),
                       bytes_of(t[2]),
                       bytes_of(t[3]),
                       t[4].cast<std::size_t>(),
                       t[5].cast<std::size_t>()};
  };
  const auto str = [](const MessageView& m) { return shown_text(m.str()); };
  type.def_property_readonly(
          "severity", [](const MessageView& m) { return to_string(m.severity); }, "error, warning or lost")
      .def_property_readonly(
          "name", [](const MessageView& m) { return shown_text(m.name); },
          "of the kind of message, as in docs/diagnostics.md")
      .def_property_readonly(
          "text", [](const MessageView& m) { return shown_text(m.text); }, "in words")
      .def_property_readonly(
          "file", [](const MessageView& m) { return text_value(m.file); }, "where it is, or ''")
      .def_readonly("line", &MessageView::line, "from 1")
      .def_readonly("column", &MessageView::column, "from 1, in bytes")
      .def("__str__", str)
      .def("__repr__", str)
      .def(py::pickle(pickled, unpickled));
}

void define_node(py::class_<PyNode>& type) {
  type.def_property_readonly(
          "type", [](const PyNode& n) { return Text{std::string(n.type().name)}; }, "Its type: 'Material'.")
      .def_property(
          "name", [](const PyNode& n) { return Text{std::string(n.scene().name(n.id))}; },
          [](const PyNode& n, const Text& name) { n.scene().set_name(n.id, n.scene().keep(name.bytes)); },
          "The DEF name, or ''.")
      .def_property_readonly(
          "world", [](const PyNode& n) { return n.world; }, "The World that it is of.")
      .def_property_readonly("fields", &fields_of, "Names of all fields that a node of this type has.")
      .def(
          "is_a", [](const PyNode& n, const Text& base) { return n.type().is_named(base.bytes); }, py::arg("type"),
          "Whether it is of that type, or of a type that is one: X3DGeometryNode.")
      .def("mesh", &mesh_of,
           "The mesh of a geometry node, as the passes see it. Empty before `tessellate` for Box and the like.")
      .def("__getattr__", &get_field)
      .def("__setattr__", &set_attribute)
      .def("__getitem__", &get_field, "Fields that are called as a property is: navigation['type'].")
      .def("__setitem__", &set_field)
      .def("__dir__",
           [](const py::object& self) {
             auto names = fields_of(self.cast<const PyNode&>());
             for (auto name : py::list(self.get_type().attr("__dict__").attr("keys")()))
               names.push_back(name.cast<Text>());
             return names;
           })
      .def(
          "__eq__", [](const PyNode& a, const PyNode& b) { return a == b; }, py::is_operator())
      .def("__hash__", [](const PyNode& n) { return std::hash<std::uint32_t>()(n.id.value); })
      .def("__copy__", &copied)
      .def("__repr__", [](const PyNode& n) {
        const std::string name(n.scene().name(n.id));
        return shown_text("<" + std::string(n.type().name) + (name.empty() ? "" : " " + name) + ">");
      });
  not_copied(type, {"__deepcopy__", "__reduce_ex__"},
             "a Node is a part of its World and cannot be pickled or copied without it; copy.copy(node) makes another "
             "node of that World with the same fields");
}

void define_mesh(py::class_<PyMesh>& type) {
  const auto mesh = [](const py::object& self) -> const Mesh& { return self.cast<PyMesh&>().mesh; };
  type.def_property_readonly(
          "positions", [mesh](const py::object& self) { return view(self, mesh(self).positions.span(), 3); },
          "n x 3, float64, metres in the coordinates of the geometry")
      .def_property_readonly(
          "corners", [mesh](const py::object& self) { return view<std::uint32_t>(self, mesh(self).corners, 1); },
          "the position of each corner, uint32")
      .def_property_readonly(
          "face_begin", [mesh](const py::object& self) { return view<std::uint32_t>(self, mesh(self).face_begin, 1); },
          "first corner of each face, and the end; empty: all are triangles")
      .def_property_readonly(
          "n_faces", [](const PyMesh& p) { return p.mesh.n_faces(); }, "how many polygons");
}

using WorldClass = py::class_<PyWorld, std::shared_ptr<PyWorld>>;

py::str repr_of_world(PyWorld& w) {
  const auto name = fs::path(w.path()).filename().string();
  auto text =
      "<World" + (name.empty() ? "" : " " + name + ":") + " " + std::to_string(w.scene().node_count()) + " nodes";
  for (const auto s : {Severity::error, Severity::warning, Severity::lost}) {
    const auto messages = w.messages();
    const auto n = std::ranges::count(messages, s, &MessageView::severity);
    if (n > 0)
      text += ", " + std::to_string(n) + " " + std::string(to_string(s)) + (n > 1 && s != Severity::lost ? "s" : "");
  }
  return shown_text(text + ">");
}

void define_world(WorldClass& type) {
  type.def_property("roots", &roots_of, &set_roots, "Its root nodes, as a list; write the list to change it.")
      .def("nodes", &nodes_of, py::arg("type") = Text(),
           "Every node that can be reached, or those of a type or base ('Material', 'X3DGeometryNode'), parents before "
           "children.")
      .def("find", &find_node, py::arg("name"), "The first node of that DEF name, or None.")
      .def("add", &add_node, py::arg("type"), "A new node, which is nowhere yet, with fields by name.")
      .def(
          "run", [](PyWorld& world, const Text& pipeline) { return world.run(pipeline.bytes); }, py::arg("pipeline"),
          "Runs passes, as -p of the command line has them, and gives what they counted. Other threads go on "
          "meanwhile; the world is not theirs. Raises Error when one fails, ValueError when the text is no pipeline.")
      .def(
          "apply",
          [](PyWorld& world, const Text& pass, const py::kwargs& options) { return world.apply(pass.bytes, options); },
          py::arg("pass_name"),
          "Runs one pass with options by keyword, world.apply('lod', ratios=[0.3, 0.1], min_faces=200), and gives "
          "what it counted.")
      .def(
          "save",
          [](PyWorld& world, const fs::path& path, const py::kwargs& options) { world.save(path.string(), options); },
          py::arg("path"),
          "Writes .wrl, .wrz, .x3d, .x3dz, .gltf or .glb, whole or not at all; what stands below [output] in "
          "docs/recipes.md are keywords: compress='meshopt', tolerance='1mm'. The world stays as it is.")
      .def("info", &PyWorld::info, py::arg("recognise") = false,
           "What is inside, as `wrlkit info --json` says it, as a dict. With `recognise` what the parts are, too: "
           "'forms'. The world stays as it is.")
      .def(
          "report",
          [](PyWorld& world, const Text& severity, const py::str& text, const py::object& node) {
            world.report(severity.bytes, shown_bytes(text), node);
          },
          py::arg("severity"), py::arg("text"), py::arg("node") = py::none(),
          "Says something of the world, as 'error', 'warning' or 'lost', at the place of a node. It is among the "
          "messages, in --report and in the report of a corpus run.")
      .def(
          "to_bytes",
          [](PyWorld& world, const Text& format, const py::kwargs& options) {
            return world.to_bytes(format.bytes, options);
          },
          py::arg("format"),
          "What save would write to a file of that format, 'glb', 'wrl' or 'x3d', as bytes, with the same keywords. "
          "Files that the world refers to are not copied.")
      .def_property_readonly(
          "path", [](const PyWorld& w) { return text_value(w.path()); }, "The file that it was read from, or ''.")
      .def_property_readonly("messages", &PyWorld::messages,
                             "Messages about it so far, each once, as a list of Message: of each kind the first three "
                             "of every call.");
  type.def("__repr__", &repr_of_world);
  not_copied(type, {"__copy__", "__deepcopy__", "__reduce_ex__"},
             "a World cannot be copied or pickled; load its file again, or give load_bytes what to_bytes gives");
}

}  // namespace
}  // namespace wrlkit::python

PYBIND11_MODULE(_wrlkit, m) {
  using namespace wrlkit::python;
  m.attr("__version__") = WRLKIT_VERSION;
  m.doc() = "Worlds of VRML, X3D and glTF; see wrlkit.load.";
  // Classes first, so that the signatures of all functions name them.
  py::class_<wrlkit::MessageView> message(
      m, "Message", "What was wrong, repaired or lost. line and column count from 1; 0: the file as a whole.");
  py::class_<PyNode> node(m, "Node",
                          "A node of a world. Its fields are attributes: node.diffuseColor = 1, 0, 0. Fields that were "
                          "not written have their default.");
  py::class_<PyMesh> mesh(m, "Mesh",
                          "Polygons of corners. The arrays are read-only, are not copied, and hold what they lie in.");
  WorldClass world(m, "World", "A world that was read, or that a pass is given.");
  no_constructor(message, "a Message comes from World.messages or from an Error");
  no_constructor(node, "a Node comes from World.nodes(), find() or add()");
  no_constructor(mesh, "a Mesh comes from Node.mesh()");
  no_constructor(world, "a World comes from wrlkit.load(path)");
  define_message(message);
  define_node(node);
  define_mesh(mesh);
  define_world(world);
  not_copied(mesh, {"__copy__", "__deepcopy__", "__reduce_ex__"},
             "a Mesh cannot be copied or pickled; copy its arrays: mesh.positions.copy()");
  define_passes(m);
  m.def("load", &load, py::arg("path"), py::arg("allow") = std::vector<fs::path>{}, py::arg("unit") = Text(),
        py::arg("up") = Text(),
        "Reads a world. Files that it refers to are looked for next to it and below the folders in `allow`; `unit` and "
        "`up` are as --unit and --up of convert. Raises Error.");
  m.def(
      "load_bytes", &load_bytes, py::arg("data"), py::arg("name") = Text{"bytes"},
      py::arg("allow") = std::vector<fs::path>{}, py::arg("unit") = Text(), py::arg("up") = Text(),
      "Reads a world from the bytes of a file, not packed. `name` is for messages. Files that it refers to are looked "
      "for below the folders in `allow` alone. Raises Error.");
  m.def("convert", &convert_paths, py::arg("source"), py::arg("target"), py::arg("recipe") = "",
        py::arg("pipeline") = py::none(),
        "Converts a file as `wrlkit convert` does: by a recipe, a pipeline, and options by keyword, which come before "
        "what the recipe says. Returns the messages, as a list of Message; raises Error when nothing could be made.");
  m.def("node_types", &node_types,
        "Every node type of VRML97 and X3D, by name: what it is for, and its fields with their types.");
  m.def("passes", &pass_names, "Names of all passes, those of Python at the end.");
}
