// Worlds and nodes as Python sees them. The headers of pybind11 are seen in this folder only.
//
// Lifetime: a Node and every array hold the World that they are of, so nothing that Python still has goes away under
// it. A world that a pass was given is the scene of whoever runs the pass; when Python still has something of it behind
// the pass, that becomes a world of its own, which shares its arrays.
#pragma once
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <thread>
#include <vector>

#include "base/io/sink.h"
#include "convert/document.h"
#include "convert/save.h"
#include "geometry/mesh.h"
#include "passes/pipeline/pipeline.h"
#include "python/text.h"
#include "tools/cli/recipe.h"

namespace wrlkit::python {

namespace py = pybind11;

/// Raises wrlkit.Error, with all messages of the work. Its text is the message that the work has ended with, with its
/// place; `otherwise` when there is none. `cause`: the exception that a pass has ended with, or None.
[[noreturn]] void fail(const std::string& otherwise, const std::vector<MessageView>& messages,
                       const py::object& cause = py::none());

/// Options by Python's keywords: with "_" for "-", numbers, bool, texts and lists of those.
GivenOptions options_of_keywords(const py::kwargs& keywords);

/// Where files are looked for, and what the numbers of a file mean.
struct Reading {
  std::vector<std::string> allow;
  std::string unit, up;
};

/// A world with all that reading and passes need in addition. One thread at a time: what another one asks of it while
/// it is worked on raises RuntimeError.
class PyWorld : public std::enable_shared_from_this<PyWorld> {
 public:
  explicit PyWorld(Document document);
  /// The scene of whoever runs a pass.
  explicit PyWorld(Scene& scene) : lent_(&scene) {}
  PyWorld(const PyWorld&) = delete;

  static std::shared_ptr<PyWorld> load(const std::string& path, const Reading&);
  static std::shared_ptr<PyWorld> load_bytes(std::string_view bytes, const std::string& name, const Reading&);

  Scene& scene() {
    check_thread();
    return lent_ ? *lent_ : document_->scene();
  }
  /// Of the file; empty when it is the world of a pass.
  std::string path() const { return document_ ? document_->path() : std::string(); }
  std::vector<MessageView> messages() const;

  using Counts = std::map<std::string, std::uint64_t>;
  Counts run(const std::string& pipeline);
  Counts apply(const std::string& pass, const py::kwargs& options);
  void save(const std::string& path, const py::kwargs& options);
  py::bytes to_bytes(const std::string& ending, const py::kwargs& options);
  py::object info(bool recognise);
  void report(const std::string& severity, const std::string& text, const py::object& node);
  Mesh mesh(NodeId geometry);

  /// For a pass: `f` is given the World whose scene it is, where Python runs the pass on one, so that nodes are those
  /// that Python has. Otherwise one of its own, for the time of the pass: what is still held of it then is a copy.
  static void for_pass(Scene&, PassContext&, const std::function<void(const std::shared_ptr<PyWorld>&)>& f);

 private:
  class Said;
  class InUse;
  class InPass;

  void check_thread() const;
  Resources* resources() const { return lent_ ? context_->resources : document_->resources(); }
  Counts run(Pipeline& pipeline);
  Saved written(const std::string& name, const Sink* sink, const py::kwargs& options);
  /// With the same scene, whose arrays are shared.
  Document copy(const PassContext&);
  void remember(const std::vector<MessageView>&);
  void detach();

  std::optional<Document> document_;
  Scene* lent_ = nullptr;              // by a pass that is being run
  PassContext* context_ = nullptr;     // of a pass in Python that is being run on the scene
  std::vector<MessageView> messages_;  // each once
  std::set<std::string> said_;
  std::thread::id user_{};  // while it is worked on
};

/// A node of a world. Two are equal when they are the same node.
struct PyNode {
  std::shared_ptr<PyWorld> world;
  NodeId id;

  Scene& scene() const { return world->scene(); }
  const NodeType& type() const { return scene().type(id); }
  bool operator==(const PyNode& o) const { return world == o.world && id == o.id; }
};

/// An array of the scene's as NumPy sees it: no copy, read-only, and `holder` lives as long as the array.
template <class T>
py::array view(py::object holder, std::span<const T> all, std::size_t width) {
  std::vector<py::ssize_t> shape{static_cast<py::ssize_t>(all.size() / width)};
  if (width > 1) shape.push_back(static_cast<py::ssize_t>(width));
  py::array out(py::dtype::of<T>(), shape, {}, all.data(), std::move(holder));
  out.attr("flags").attr("writeable") = false;
  return out;
}

/// A value in a message: its type, and what it is where that is short.
std::string shown_value(const py::object& value);

py::object get_field(const PyNode& node, const Text& name);
void set_field(const PyNode& node, const Text& name, const py::object& value);

/// A list that is read only, of what `owner` ("Group.children") holds.
struct FixedNodes : py::list {
  using py::list::list;
};
FixedNodes fixed_list(const py::object& values, const std::string& owner);

/// Converts a file as `wrlkit convert` does, by a recipe (empty: none), a pipeline and options; returns the messages.
std::vector<MessageView> convert(const std::string& source, const std::string& target, const std::string& recipe,
                                 const std::optional<std::string>& pipeline, const py::kwargs& options);

/// Passes that are Python functions, and the command line in Python (passes.cpp).
void define_passes(py::module_& module);

}  // namespace wrlkit::python

namespace pybind11::detail {

template <>
struct handle_type_name<wrlkit::python::FixedNodes> {
  static constexpr auto name = const_name("List[wrlkit._wrlkit.Node]");
};

}  // namespace pybind11::detail
