// Worlds and nodes as Python sees them. The headers of pybind11 are seen in this folder only.
//
// Lifetime: a Node and every array hold the World that they are of, so nothing that Python still has goes away under
// it. A world that a pass was given is the scene of whoever runs the pass; when Python still has something of it behind
// the pass, that becomes a world of its own, which shares its arrays.
#pragma once
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "convert/document.h"
#include "passes/pipeline/pipeline.h"
#include "tools/cli/recipe.h"

namespace wrlkit::python {

namespace py = pybind11;

/// Makes wrlkit.Error.
void define_error(py::module_& module);
/// Raises it: its text is the first error with its place, and it has all messages. The exception that a pass has ended
/// with is its cause.
[[noreturn]] void fail(const std::string& otherwise, const std::vector<MessageView>& messages);
/// What a pass has ended with, for the next `fail`.
void set_cause(py::object exception);

/// Options by Python's keywords: with "_" for "-", numbers, bool, texts and lists of those.
GivenOptions options_of_keywords(const py::kwargs& keywords);

/// A world with all that reading and passes need in addition.
class PyWorld : public std::enable_shared_from_this<PyWorld> {
 public:
  explicit PyWorld(Document document) : document_(std::move(document)) {}
  /// The world of a pass that is being run.
  PyWorld(Scene& scene, PassContext& ctx) : lent_(&scene), context_(&ctx) {}
  PyWorld(const PyWorld&) = delete;

  static std::shared_ptr<PyWorld> load(const std::string& path, std::vector<std::string> allow, const std::string& unit,
                                       const std::string& up);

  Scene& scene() { return lent_ ? *lent_ : document_->scene(); }
  Diagnostics& diag() const { return lent_ ? context_->diag : document_->diag(); }
  PassContext context(Statistics& stats) {
    return {diag(), stats, lent_ ? context_->resources : document_->resources()};
  }

  using Counts = std::map<std::string, std::uint64_t>;
  Counts run(const std::string& pipeline);
  Counts apply(const std::string& pass, const py::kwargs& options);
  void save(const std::string& path, const py::kwargs& options);
  py::object info(bool recognise);
  void report(const std::string& severity, const std::string& text, const py::object& node);
  /// The scene goes its own way: what Python still has of it is a copy from now on.
  void detach();

 private:
  Counts run(Pipeline& pipeline);
  /// The messages behind the first n.
  std::vector<MessageView> said_since(std::size_t n) const;
  /// With the same scene, whose arrays are shared.
  Document copy() const;

  std::optional<Document> document_;
  Scene* lent_ = nullptr;  // by a pass that is being run, with its context
  PassContext* context_ = nullptr;
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

py::object get_field(const PyNode& node, const std::string& name);
void set_field(const PyNode& node, const std::string& name, const py::object& value);

/// Converts a file as `wrlkit convert` does, by a recipe (empty: none), a pipeline and options; returns the messages.
std::vector<MessageView> convert(const std::string& source, const std::string& target, const std::string& recipe,
                                 const std::optional<std::string>& pipeline, const py::kwargs& options);

/// Passes that are Python functions, and the command line in Python (passes.cpp).
void define_passes(py::module_& module);

}  // namespace wrlkit::python
