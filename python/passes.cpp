// Passes that are Python functions. wrlkit/definitions.py makes a definition of a function: its options with their
// types, what reads them and what calls it. Here the definition becomes a pass among the others, which pipelines,
// recipes and the command line know by name.
#include <algorithm>
#include <memory>
#include <new>
#include <unordered_map>

#include "base/text/nearest_name.h"
#include "python/interrupts.h"
#include "python/world.h"
#include "tools/cli/cli.h"
#include "tools/cli/python_passes.h"
#include "tools/corpus/workers.h"

namespace wrlkit::python {
namespace {

/// What was defined; the list of passes keeps it for good.
struct Definition : PassInfo {
  std::string name_text, summary_text, doc_text;
  py::object python;                // wrlkit.definitions.Definition
  std::vector<OptionInfo> options;  // with their defaults
};

/// With the places that it came by.
py::object exception_of(const py::error_already_set& e) {
  if (e.trace()) PyException_SetTraceback(e.value().ptr(), e.trace().ptr());
  return e.value();
}

class PythonPass final : public PassInstance {
 public:
  explicit PythonPass(const Definition& definition) : definition_(definition), options_(definition.options) {}

  bool is_mesh_pass() const override { return false; }
  Outcome run(MeshJob&) const override { return Outcome::failed; }

  Outcome run(Scene& scene, PassContext& ctx) const override {
    bool good = false;
    call_python([&] {
      PyWorld::for_pass(scene, ctx, [&](const std::shared_ptr<PyWorld>& world) { good = call(world, ctx); });
    });
    return good ? Outcome::changed : Outcome::failed;
  }

  bool set(std::string_view option, std::string_view value, std::string& why) override {
    py::gil_scoped_acquire lock;
    const auto at = std::ranges::find(options_, option, &OptionInfo::name);
    if (at == options_.end()) {
      NearestName nearest(option);
      for (const auto& o : options_) nearest.consider(o.name);
      why = "has no option '" + std::string(option) + "'" + nearest.question();
      return false;
    }
    try {
      at->value = bytes_of(definition_.python.attr("read")(text_value(option), text_value(value)));
      return true;
    } catch (py::error_already_set& e) {
      if (!e.matches(PyExc_ValueError)) throw;
    }
    why = "option '" + std::string(option) + "': '" + std::string(value) +
          "' is not a valid value: " + at->type_and_range();
    return false;
  }

  std::vector<OptionInfo> options() const override { return options_; }

  std::vector<std::string> files() const override {
    py::gil_scoped_acquire lock;
    std::vector<std::string> out;
    for (const auto& file : definition_.python.attr("files")(values())) out.push_back(bytes_of(file));
    return out;
  }

 private:
  py::dict values() const {
    py::dict out;
    for (const auto& o : options_) out[py::str(o.name)] = text_value(o.value);
    return out;
  }

  bool call(const std::shared_ptr<PyWorld>& world, PassContext& ctx) const {
    try {
      const py::dict counts = definition_.python.attr("call")(world, values());
      for (const auto& [name, n] : counts)
        ctx.stats[definition_.name_text + "." + name.cast<std::string>()] += n.cast<std::uint64_t>();
      return true;
    } catch (py::error_already_set& e) {
      if (e.matches(PyExc_MemoryError)) throw std::bad_alloc();
      const auto exception = exception_of(e);
      if (is_fault_of_pass(e))
        ctx.diag.report(Diag::python_failed, Span{}, definition_.name_text,
                        shown_bytes(definition_.python.attr("describe")(exception)));
    } catch (const py::cast_error&) {
      ctx.diag.report(Diag::python_failed, Span{}, definition_.name_text,
                      "what it returns is neither None nor a dict of counts");
    }
    return false;
  }

  const Definition& definition_;
  std::vector<OptionInfo> options_;
};

/// `python`: a wrlkit.definitions.Definition.
void define(const py::object& python) {
  const auto definition = std::make_shared<Definition>();
  auto& d = *definition;
  d.python = python;
  d.name_text = python.attr("name").cast<std::string>();
  d.summary_text = python.attr("summary").cast<std::string>();
  d.doc_text = python.attr("doc").cast<std::string>();
  for (const auto& o : python.attr("described")().cast<std::vector<std::array<std::string, 4>>>())
    d.options.push_back({o[0], o[1], o[2], o[3], {}});
  static_cast<PassInfo&>(d) = {d.name_text,
                               d.summary_text,
                               Level::authored,
                               Level::authored,
                               [](const PassInfo& info) -> std::unique_ptr<PassInstance> {
                                 return std::make_unique<PythonPass>(static_cast<const Definition&>(info));
                               },
                               d.doc_text};
  if (!add_pass(definition))
    throw py::value_error("there is a pass '" + d.name_text + "' already; give this one another name");
}

bool load_file(const std::string& path, std::string& why) {
  py::gil_scoped_acquire lock;
  try {
    py::module_::import("wrlkit.definitions").attr("load")(text_value(path));
    return true;
  } catch (py::error_already_set& e) {
    if (e.matches(PyExc_KeyboardInterrupt)) throw;
    why = shown_bytes(py::module_::import("wrlkit.definitions").attr("describe")(exception_of(e), text_value(path)));
    return false;
  }
}

/// The verbs of the program. Python is held all the time: workers of a corpus run are forks, so no other thread may
/// run.
int run_verb(std::vector<Text> words) {
  words.insert(words.begin(), Text{"wrlkit"});
  std::vector<char*> arguments;
  for (auto& w : words) arguments.push_back(w.bytes.data());
  arguments.push_back(nullptr);
  return run_program(static_cast<int>(words.size()), arguments.data());
}

}  // namespace

void define_passes(py::module_& m) {
  load_python_file = &load_file;
  fork_hooks = {PyOS_BeforeFork, PyOS_AfterFork_Parent, PyOS_AfterFork_Child};
  m.def("_define", &define, py::arg("definition"), "Makes a pass of a definition.");
  m.def("_main", &run_verb, py::arg("words"),
        "Runs a command line of the program, ['convert', 'in.wrl', 'out.glb'], and gives its exit code. It prints as "
        "the program does, and may end the process as the program does.");
}

}  // namespace wrlkit::python
