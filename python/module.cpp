// The Python module wrlkit._wrlkit: worlds, their nodes with the fields of the node table as attributes, meshes and arrays of
// numbers as NumPy arrays that are the scene's own memory, passes by the text of a pipeline. The only door to pybind11.
//
// Lifetime: a Node and every array hold the World that they are of, so nothing that Python still has goes away under it.
// The arrays of a scene never change, so those that Python sees are read-only; writing a field puts a new array into the scene.
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <filesystem>

#include "parsers/parsers.h"
#include "parsers/resources.h"
#include "passes/geometry.h"
#include "passes/lower_vrml1.h"
#include "passes/pipeline.h"
#include "scenegraph/nearest_name.h"
#include "scenegraph/nodes.h"
#include "scenegraph/walk.h"
#include "writers/gltf.h"
#include "writers/made_files.h"
#include "writers/vrml.h"
#include "writers/x3d.h"

namespace py = pybind11;

namespace wrlkit {
namespace {

/// A message as Python has it.
struct MessageView {
  std::string severity, name, text, file;
  std::size_t line, column;

  std::string str() const { return (file.empty() ? "" : file + (line ? ":" + std::to_string(line) + ":" + std::to_string(column) : "") + ": ") + severity + ": " + text + " [" + name + "]"; }
};

std::vector<MessageView> views(const Diagnostics& diag) {
  std::vector<MessageView> out;
  for (const auto& m : diag.messages()) {
    const Place p = diag.sources().locate(m.where);
    const bool exact = p.line && m.where.length;
    out.push_back({std::string(to_string(m.severity)), info(m.id).name, m.text(), std::string(p.file), exact ? p.line : 0, exact ? p.column : 0});
  }
  return out;
}

PyObject* error_type = nullptr;

/// wrlkit.Error: its text is the first error with its place, and it has all messages.
[[noreturn]] void fail(const std::string& otherwise, const std::vector<MessageView>& messages) {
  std::string text = otherwise;
  for (const auto& m : messages)
    if (m.severity == "error") {
      text = m.str();
      break;
    }
  auto error = py::reinterpret_borrow<py::object>(error_type)(text);
  error.attr("messages") = messages;
  PyErr_SetObject(error_type, error.ptr());
  throw py::error_already_set();
}

}  // namespace

/// A world with all that reading and passes need beside it.
class PyWorld : public std::enable_shared_from_this<PyWorld> {
 public:
  Diagnostics diag;
  std::unique_ptr<World> world;
  std::unique_ptr<FileResources> resources;

  Scene& scene() { return world->scene; }

  static std::shared_ptr<PyWorld> load(const std::string& path, std::vector<std::string> allow) {
    auto w = std::make_shared<PyWorld>();
    {
      py::gil_scoped_release others;
      auto inlined = [](const std::string& file, Diagnostics& diag) -> std::shared_ptr<const Scene> {
        auto read = read_world(file, {}, diag);
        Statistics uncounted;
        PassContext ctx{diag, uncounted};
        if (read) lower_vrml1(read->scene, {}, ctx);
        return read ? std::make_shared<const Scene>(std::move(read->scene)) : nullptr;
      };
      w->resources = std::make_unique<FileResources>(ResourceOptions{.input = path, .allowed = allow}, inlined);
      w->world = read_world(path, {.allowed = std::move(allow)}, w->diag);
      if (w->world) w->resources->set_root({std::shared_ptr<const Scene>{}, &w->scene()});
    }
    if (!w->world) fail(path + ": there is no world in it", views(w->diag));
    return w;
  }

  std::map<std::string, std::uint64_t> run(const std::string& text) {
    std::string why;
    auto pipeline = Pipeline::parse(text, why);
    if (!pipeline) throw py::value_error(why);
    Statistics stats;
    bool good;
    {
      py::gil_scoped_release others;
      PassContext ctx{diag, stats, resources.get()};
      good = pipeline->run(scene(), ctx);
    }
    if (!good) fail("the pipeline has failed", views(diag));
    return {stats.begin(), stats.end()};
  }

  void save(const std::string& path) {
    const bool binary = path.ends_with(".glb"), gltf = binary || path.ends_with(".gltf"), x3d = path.ends_with(".x3d");
    if (!gltf && !x3d && !path.ends_with(".wrl")) throw py::value_error("'" + path + "': worlds are written as .wrl, .x3d, .gltf or .glb");
    bool good;
    {
      py::gil_scoped_release others;
      Scene copy = scene();  // what the format needs is done to a copy: its arrays are shared
      std::string why;
      auto pipeline = *Pipeline::parse(gltf ? "gltf" : x3d ? "x3d" : "vrml", why);
      Statistics stats;
      PassContext ctx{diag, stats, resources.get()};
      MadeFiles beside(copy, *resources, path, diag);
      if (gltf) {
        auto meshes = pipeline.run_lazily(copy, ctx);
        good = meshes && beside.write() && write_gltf(copy, meshes, {.binary = binary}, resources.get(), path, diag) && beside.commit();
      } else {
        good = pipeline.run(copy, ctx) && write_text(copy, path, x3d, beside);
      }
    }
    if (!good) fail(path + ": it could not be written", views(diag));
  }

 private:
  bool write_text(const Scene& copy, const std::string& path, bool x3d, MadeFiles& beside) {
    auto file = OutputFile::open(path, {}, diag);
    if (!file) return false;
    const auto place = [&](std::string_view url) { return beside.place(url); };
    if (x3d) write_x3d(copy, {.file = path, .place = place}, file->sink(), diag);
    else write_vrml(copy, {.file = path, .place = place}, file->sink(), diag);
    return beside.write() && beside.commit() && file->commit(diag);
  }
};

namespace {

/// A node of a world. Two are equal when they are the same node.
struct PyNode {
  std::shared_ptr<PyWorld> world;
  NodeId id;

  Scene& scene() const { return world->scene(); }
  const NodeType& type() const { return scene().type(id); }
  bool operator==(const PyNode& o) const { return world == o.world && id == o.id; }
};

/// An array of the scene's as NumPy sees it: no copy, read-only, and the world lives as long as the array.
template <class T>
py::array view(const std::shared_ptr<PyWorld>& world, std::span<const T> all, std::size_t width) {
  std::vector<py::ssize_t> shape{static_cast<py::ssize_t>(all.size() / width)};
  if (width > 1) shape.push_back(static_cast<py::ssize_t>(width));
  py::array out(py::dtype::of<T>(), shape, {}, all.data(), py::cast(world));
  out.attr("flags").attr("writeable") = false;
  return out;
}

py::object to_python(const PyNode& node, const Value& v) {
  const auto& t = info(v.type);
  auto tuple = [](auto span) {
    py::tuple out(span.size());
    for (std::size_t i = 0; i < span.size(); ++i) out[i] = span[i];
    return out;
  };
  switch (t.element) {
    case Element::number:
      if (t.multiple) return view(node.world, v.number_span(), t.arity);
      return t.arity == 1 ? py::object(py::float_(v.number)) : py::object(tuple(v.number_span()));
    case Element::integer:
      if (t.multiple) return view(node.world, v.integer_span(), 1);
      return v.type == FieldType::SFBool ? py::object(py::bool_(v.integer != 0)) : py::object(py::int_(v.integer));
    case Element::image: return view(node.world, v.integer_span(), 1);
    case Element::text:
      if (t.multiple) return py::cast(std::vector<std::string>(v.text_span().begin(), v.text_span().end()));
      return py::str(std::string(v.text()));
    case Element::node:
      if (!t.multiple) return v.node ? py::cast(PyNode{node.world, v.node}) : py::none();
      std::vector<PyNode> nodes;
      for (NodeId n : v.node_span()) nodes.push_back({node.world, n});
      return py::cast(nodes);
  }
  return py::none();
}

NodeId node_of(const PyNode& holder, const py::handle& value) {
  if (value.is_none()) return {};
  const auto& node = value.cast<const PyNode&>();
  if (node.world != holder.world) throw py::value_error("the node is of another world");
  return node.id;
}

Value from_python(const PyNode& node, const FieldDef& field, std::uint16_t slot, const py::object& value) {
  const auto& t = info(field.type);
  Scene& scene = node.scene();
  const auto wrong = [&] { return py::type_error(std::string(node.type().name) + "." + std::string(field.name) + " is a " + std::string(t.name)); };
  try {
    switch (t.element) {
      case Element::number: {
        if (t.arity == 1 && !t.multiple) return scene.make(field.type, slot, value.cast<double>());
        const auto array = py::array_t<double, py::array::c_style | py::array::forcecast>::ensure(value);
        if (!array || array.size() % t.arity != 0 || (!t.multiple && array.size() != t.arity)) throw wrong();
        return scene.make(field.type, slot, std::span<const double>(array.data(), static_cast<std::size_t>(array.size())));
      }
      case Element::integer:
      case Element::image: {
        if (field.type == FieldType::SFBool) return scene.make(field.type, slot, value.cast<bool>());
        if (field.type == FieldType::SFInt32) return scene.make(field.type, slot, value.cast<std::int32_t>());
        const auto array = py::array_t<std::int32_t, py::array::c_style | py::array::forcecast>::ensure(value);
        if (!array) throw wrong();
        return scene.make(field.type, slot, std::span<const std::int32_t>(array.data(), static_cast<std::size_t>(array.size())));
      }
      case Element::text: {
        if (!t.multiple) return scene.make(field.type, slot, value.cast<std::string>());
        const auto texts = py::isinstance<py::str>(value) ? std::vector{value.cast<std::string>()} : value.cast<std::vector<std::string>>();
        const std::vector<std::string_view> kept(texts.begin(), texts.end());
        return scene.make(field.type, slot, kept);
      }
      case Element::node: {
        if (!t.multiple) return scene.make(field.type, slot, node_of(node, value));
        std::vector<NodeId> ids;
        for (auto item : value) ids.push_back(node_of(node, item));
        return scene.make(field.type, slot, ids);
      }
    }
  } catch (const py::cast_error&) {
    throw wrong();
  }
  throw wrong();
}

std::uint16_t slot_of(const PyNode& node, const std::string& name) {
  auto slot = node.type().find(name, Dialect::vrml97);
  if (!slot) slot = node.type().find(name, Dialect::x3d);
  if (slot && node.type().fields[*slot].has_value()) return *slot;
  NearestName nearest(name);
  for (const auto& f : node.type().fields) nearest.consider(f.name);
  throw py::attribute_error(std::string(node.type().name) + " has no field '" + name + "'" + nearest.question());
}

void set_field(const PyNode& node, const std::string& name, const py::object& value) {
  const auto slot = slot_of(node, name);
  node.scene().set(node.id, from_python(node, node.type().fields[slot], slot, value));
}

/// What a geometry node shows, as passes see it.
struct PyMesh {
  std::shared_ptr<PyWorld> world;
  Mesh mesh;
};

std::unique_ptr<PyMesh> mesh_of(const PyNode& node) {
  if (!node.type().is_a("X3DGeometryNode")) throw py::type_error(std::string(node.type().name) + " is no geometry");
  auto out = std::make_unique<PyMesh>();
  out->world = node.world;
  MeshScratch scratch;
  Statistics stats;
  PassContext ctx{node.world->diag, stats, node.world->resources.get()};
  MeshJob job{node.scene(), node.id, out->mesh, scratch, ctx};
  read_mesh(job);
  return out;
}

/// An array of the mesh, which lives as long as the array does.
template <class T>
py::array of_mesh(const py::object& self, std::span<const T> all, std::size_t width) {
  std::vector<py::ssize_t> shape{static_cast<py::ssize_t>(all.size() / width)};
  if (width > 1) shape.push_back(static_cast<py::ssize_t>(width));
  py::array out(py::dtype::of<T>(), shape, {}, all.data(), self);
  out.attr("flags").attr("writeable") = false;
  return out;
}

std::vector<PyNode> nodes_of(const std::shared_ptr<PyWorld>& world, const std::string& type) {
  std::vector<PyNode> out;
  for (NodeId n : reachable(world->scene(), world->scene().main))
    if (type.empty() || world->scene().type(n).name == type || world->scene().type(n).is_a(type)) out.push_back({world, n});
  return out;
}

}  // namespace
}  // namespace wrlkit

PYBIND11_MODULE(_wrlkit, m) {
  using namespace wrlkit;
  m.doc() = "Worlds of VRML, X3D and glTF; see wrlkit.load.";
  error_type = PyErr_NewExceptionWithDoc("wrlkit.Error", "Nothing could be made of a world. messages: all that was said of it.", PyExc_RuntimeError, nullptr);
  m.attr("Error") = py::reinterpret_borrow<py::object>(error_type);

  py::class_<MessageView>(m, "Message", "What was wrong, repaired or lost. line and column count from 1; 0: the file as a whole.")
      .def_readonly("severity", &MessageView::severity).def_readonly("name", &MessageView::name).def_readonly("text", &MessageView::text)
      .def_readonly("file", &MessageView::file).def_readonly("line", &MessageView::line).def_readonly("column", &MessageView::column)
      .def("__str__", &MessageView::str).def("__repr__", &MessageView::str);

  py::class_<PyNode>(m, "Node", "A node of a world. Its fields are attributes: node.diffuseColor = 1, 0, 0. Fields that were not written have their default.")
      .def_property_readonly("type", [](const PyNode& n) { return std::string(n.type().name); })
      .def_property("name", [](const PyNode& n) { return std::string(n.scene().name(n.id)); }, [](const PyNode& n, const std::string& name) { n.scene().set_name(n.id, n.scene().keep(name)); }, "The DEF name, or ''.")
      .def_property_readonly("world", [](const PyNode& n) { return n.world; })
      .def_property_readonly("fields", [](const PyNode& n) {
        std::vector<std::string> names;
        for (const auto& f : n.type().fields)
          if (f.has_value()) names.emplace_back(f.name_in(Dialect::vrml97));
        return names;
      }, "Names of all fields that a node of this type has.")
      .def("is_a", [](const PyNode& n, const std::string& base) { return n.type().name == base || n.type().is_a(base); }, py::arg("type"), "Whether it is of that type, or of a type that is one: X3DGeometryNode.")
      .def("mesh", &mesh_of, "The mesh of a geometry node, as the passes see it. Empty before `tessellate` for Box and the like.")
      .def("__getattr__", [](const PyNode& n, const std::string& name) { return to_python(n, n.scene().value(n.id, slot_of(n, name))); })
      .def("__setattr__", [](const py::object& self, const std::string& name, const py::object& value) {
        if (name == "name") self.get_type().attr("name").attr("__set__")(self, value);
        else set_field(self.cast<const PyNode&>(), name, value);
      })
      .def("__getitem__", [](const PyNode& n, const std::string& name) { return to_python(n, n.scene().value(n.id, slot_of(n, name))); }, "Fields that are called as a property is: navigation['type'].")
      .def("__setitem__", &set_field)
      .def("__eq__", [](const PyNode& a, const PyNode& b) { return a == b; }, py::is_operator())
      .def("__hash__", [](const PyNode& n) { return std::hash<std::uint32_t>()(n.id.value); })
      .def("__repr__", [](const PyNode& n) { return "<" + std::string(n.type().name) + (n.scene().name(n.id).empty() ? "" : " " + std::string(n.scene().name(n.id))) + ">"; });

  py::class_<PyMesh>(m, "Mesh", "Polygons of corners. The arrays are read-only, are not copied, and hold what they lie in.")
      .def_property_readonly("positions", [](const py::object& self) { return of_mesh(self, self.cast<PyMesh&>().mesh.positions.span(), 3); }, "n x 3, float64, metres in the coordinates of the geometry")
      .def_property_readonly("corners", [](const py::object& self) { return of_mesh<std::uint32_t>(self, self.cast<PyMesh&>().mesh.corners, 1); }, "the position of each corner, uint32")
      .def_property_readonly("face_begin", [](const py::object& self) { return of_mesh<std::uint32_t>(self, self.cast<PyMesh&>().mesh.face_begin, 1); }, "first corner of each face, and the end; empty: all are triangles")
      .def_property_readonly("n_faces", [](const PyMesh& p) { return p.mesh.n_faces(); });

  py::class_<PyWorld, std::shared_ptr<PyWorld>>(m, "World", "A world that was read.")
      .def_property("roots", [](const std::shared_ptr<PyWorld>& w) {
        std::vector<PyNode> out;
        for (NodeId n : w->scene().main.roots) out.push_back({w, n});
        return out;
      }, [](const std::shared_ptr<PyWorld>& w, const std::vector<PyNode>& nodes) {
        std::vector<NodeId> ids;
        for (const auto& n : nodes) ids.push_back(n.world == w ? n.id : throw py::value_error("the node is of another world"));
        w->scene().main.roots = ids;
      })
      .def("nodes", &nodes_of, py::arg("type") = "", "Every node that can be reached, or those of a type or base ('Material', 'X3DGeometryNode'), parents before children.")
      .def("find", [](const std::shared_ptr<PyWorld>& w, const std::string& name) -> py::object {
        for (const auto& n : nodes_of(w, ""))
          if (n.scene().name(n.id) == name) return py::cast(n);
        return py::none();
      }, py::arg("name"), "The first node of that DEF name, or None.")
      .def("add", [](const std::shared_ptr<PyWorld>& w, const std::string& type, const py::kwargs& fields) {
        auto id = find_builtin(type, Dialect::vrml97);
        if (!id) id = find_builtin(type, Dialect::x3d);
        if (!id) throw py::value_error("there is no node type '" + type + "'");
        PyNode node{w, w->scene().add(id)};
        for (const auto& [name, value] : fields) set_field(node, name.cast<std::string>(), py::reinterpret_borrow<py::object>(value));
        return node;
      }, py::arg("type"), "A new node, which is nowhere yet, with fields by name.")
      .def("run", &PyWorld::run, py::arg("pipeline"), "Runs passes, as -p of the command line has them, and gives what they counted. Other threads go on meanwhile; the world is not theirs.")
      .def("save", &PyWorld::save, py::arg("path"), "Writes .wrl, .x3d, .gltf or .glb, whole or not at all. The world stays as it is.")
      .def_property_readonly("messages", [](const PyWorld& w) { return views(w.diag); }, "All that was said of it until now.")
      .def("__repr__", [](PyWorld& w) { return "<World of " + std::to_string(w.scene().node_count()) + " nodes>"; });

  m.def("load", &PyWorld::load, py::arg("path"), py::arg("allow") = std::vector<std::string>{}, "Reads a world. Files that it refers to are looked for beside it and below the folders in `allow`. Raises wrlkit.Error.");
  m.def("passes", [] {
    std::vector<std::string> names;
    for (const auto& p : passes()) names.emplace_back(p.name);
    return names;
  }, "Names of all passes.");
}
