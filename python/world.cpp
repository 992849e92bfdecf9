#include "python/world.h"

#include <algorithm>
#include <cmath>

#include "base/text/nearest_name.h"
#include "passes/lower_vrml1/lower_vrml1.h"
#include "tools/cli/cli.h"
#include "tools/cli/lengths.h"
#include "tools/cli/python_passes.h"
#include "tools/gltf_output.h"
#include "tools/verbs/convert.h"
#include "tools/verbs/info.h"

namespace wrlkit::python {
namespace {

PyObject* error_type = nullptr;
py::object* cause = nullptr;

std::shared_ptr<const Scene> parse_inlined(const std::string& file, Diagnostics& diag) {
  auto read = read_world(file, {}, diag);
  Statistics uncounted;
  PassContext ctx{diag, uncounted};
  if (read) lower_vrml1(read->scene, {}, ctx);
  return read ? std::make_shared<const Scene>(std::move(read->scene)) : nullptr;
}

std::string text_of(const py::handle& value) {
  if (py::isinstance<py::bool_>(value)) return value.cast<bool>() ? "true" : "false";
  return py::str(value);
}

/// Adds options of `convert`; those of the sections alone when there are some.
void add_options(Recipe& recipe, const GivenOptions& options, std::initializer_list<std::string_view> sections) {
  const auto known = options_of("convert");
  const auto fits = [&](std::string_view name) {
    return std::ranges::find(sections, recipe_section(name)) != sections.end();
  };
  for (const auto& [name, values] : options) {
    std::string why;
    NearestName nearest(name);
    for (const auto& o : known)
      if (fits(o.name)) nearest.consider(o.name);
    if (std::ranges::find(known, name, &OptionHelp::name) == known.end() || !fits(name))
      throw py::type_error("there is no option '" + name + "'" + nearest.question());
    if (!check_option("convert", name, values, why)) throw py::value_error(why);
    std::erase_if(recipe.options, [&](const auto& o) { return o.first == name; });
    recipe.options.emplace_back(name, values);
  }
}

Flags flags_of(const Recipe& recipe, const std::string& target) {
  if (!is_output_name(target))
    throw py::value_error("'" + target + "': worlds are written as .wrl, .wrz, .x3d, .x3dz, .gltf or .glb");
  Flags flags = conversion_flags(recipe);
  if (!flags.tolerance.empty() && !(length_of(flags.tolerance) > 0))
    throw py::value_error("tolerance: '" + flags.tolerance + "' is no length");
  flags.output = target;
  flags.quiet = true;
  apply_profile(flags);
  return flags;
}

}  // namespace

std::string MessageView::str() const {
  return (file.empty() ? "" : file + (line ? ":" + std::to_string(line) + ":" + std::to_string(column) : "") + ": ") +
         severity + ": " + text + " [" + name + "]";
}

std::vector<MessageView> views(const Diagnostics& diag) {
  std::vector<MessageView> out;
  for (const auto& m : diag.messages()) {
    const Place p = diag.sources().locate(m.where);
    const bool exact = p.line && m.where.length;
    out.push_back({std::string(to_string(m.severity)), info(m.id).name, m.text(), std::string(p.file),
                   exact ? p.line : 0, exact ? p.column : 0});
  }
  return out;
}

void define_error(py::module_& module) {
  error_type = PyErr_NewExceptionWithDoc(
      "wrlkit.Error", "Nothing could be made of a world. messages: all that was said of it, as a list of Message.",
      PyExc_RuntimeError, nullptr);
  module.attr("Error") = py::reinterpret_borrow<py::object>(error_type);
  cause = new py::object(py::none());
}

void set_cause(py::object exception) { *cause = std::move(exception); }

void fail(const std::string& otherwise, const std::vector<MessageView>& messages) {
  std::string text = otherwise;
  for (const auto& m : messages)
    if (m.severity == "error") {
      text = m.str();
      break;
    }
  auto error = py::reinterpret_borrow<py::object>(error_type)(text);
  error.attr("messages") = messages;
  if (!cause->is_none()) error.attr("__cause__") = std::exchange(*cause, py::none());
  PyErr_SetObject(error_type, error.ptr());
  throw py::error_already_set();
}

GivenOptions options_of_keywords(const py::kwargs& keywords) {
  GivenOptions out;
  for (const auto& [key, value] : keywords) {
    auto name = key.cast<std::string>();
    std::ranges::replace(name, '_', '-');
    std::vector<std::string> values;
    if (py::isinstance<py::list>(value) || py::isinstance<py::tuple>(value))
      for (auto item : value) values.push_back(text_of(item));
    else
      values.push_back(text_of(value));
    out.emplace_back(std::move(name), std::move(values));
  }
  return out;
}

void PyWorld::own(std::unique_ptr<World> world) {
  own_world_ = std::move(world);
  scene_ = &own_world_->scene;
  own_resources_->set_root({std::shared_ptr<const Scene>{}, scene_});
  resources_ = own_resources_.get();
}

std::shared_ptr<PyWorld> PyWorld::load(const std::string& path, std::vector<std::string> allow, const std::string& unit,
                                       const std::string& up) {
  for (const auto& [option, value] : {std::pair("unit", unit), std::pair("up", up)})
    if (std::string why; !value.empty() && !check_option("convert", option, {value}, why)) throw py::value_error(why);
  auto w = std::make_shared<PyWorld>();
  w->path_ = path;
  std::unique_ptr<World> world;
  {
    py::gil_scoped_release others;
    w->own_resources_ =
        std::make_unique<FileResources>(ResourceOptions{.input = path, .allowed = allow}, parse_inlined);
    world = read_world(path, {.allowed = std::move(allow)}, w->own_diag_);
    if (world) place_world(world->scene, unit, up);
  }
  if (!world) fail(path + ": there is no world in it", views(w->own_diag_));
  w->own(std::move(world));
  return w;
}

PyWorld::Counts PyWorld::run(Pipeline& pipeline) {
  Statistics stats;
  bool good = false;
  const auto said_before = diag_->messages().size();
  {
    py::gil_scoped_release others;
    auto ctx = context(stats);
    good = pipeline.run(scene(), ctx);
  }
  if (!good) {
    auto said = views(*diag_);
    said.erase(said.begin(), said.begin() + static_cast<std::ptrdiff_t>(std::min(said_before, said.size())));
    fail("the pipeline has failed", said);
  }
  return {stats.begin(), stats.end()};
}

PyWorld::Counts PyWorld::run(const std::string& text) {
  std::string why;
  auto pipeline = Pipeline::parse(text, why);
  if (!pipeline) throw py::value_error(why);
  return run(*pipeline);
}

PyWorld::Counts PyWorld::apply(const std::string& pass, const py::kwargs& keywords) {
  std::vector<std::pair<std::string, std::string>> options;
  for (const auto& [name, values] : options_of_keywords(keywords)) {
    std::string value;
    for (const auto& v : values) value += (value.empty() ? "" : ":") + v;
    options.emplace_back(name, value);
  }
  std::string why;
  Pipeline pipeline;
  if (!pipeline.add(pass, options, why)) throw py::value_error(why);
  return run(pipeline);
}

std::unique_ptr<World> PyWorld::copy() const {
  auto world = std::make_unique<World>();
  if (own_world_)
    *world = *own_world_;
  else
    world->scene = *scene_;
  return world;
}

void PyWorld::save(const std::string& path, const py::kwargs& options) {
  Recipe recipe;
  add_options(recipe, options_of_keywords(options), {"output"});
  const Flags flags = flags_of(recipe, path);
  bool good = false;
  {
    py::gil_scoped_release others;
    Session s(flags, copy(), *resources_, *diag_);  // what the format needs is done to a copy: its arrays are shared
    good = prepare_conversion(s) && write_world(s);
  }
  if (!good) fail(path + ": it could not be written", views(*diag_));
}

py::object PyWorld::info() {
  Flags flags;
  flags.json = flags.quiet = true;
  flags.inputs = {path_};
  std::optional<std::string> text;
  {
    py::gil_scoped_release others;
    Session s(flags, copy(), *resources_, *diag_);
    text = info_of(s);
  }
  if (!text) fail(path_ + ": its figures cannot be had", views(*diag_));
  return py::module_::import("json").attr("loads")(*text);
}

void PyWorld::report(const std::string& severity, const std::string& text, const py::object& node) {
  const Span where = node.is_none() ? Span{} : scene().where(node.cast<const PyNode&>().id);
  if (severity == "error")
    diag_->report(Diag::python_error, where, text);
  else if (severity == "warning")
    diag_->report(Diag::python_warning, where, text);
  else if (severity == "lost")
    diag_->report(Diag::python_lost, where, text);
  else
    throw py::value_error("'" + severity + "' is no severity: error, warning or lost");
}

void PyWorld::detach() {
  if (own_world_) return;
  own_diag_ = Diagnostics(diag_->shared_sources());
  diag_ = &own_diag_;
  own_resources_ = std::make_unique<FileResources>(ResourceOptions{}, parse_inlined);
  own(copy());
}

std::vector<MessageView> convert(const std::string& source, const std::string& target, const std::string& recipe_path,
                                 const std::optional<std::string>& pipeline, const py::kwargs& options) {
  std::string why;
  Recipe recipe;
  if (!recipe_path.empty()) {
    auto read = read_recipe(recipe_path, why);
    if (!read) throw py::value_error(why);
    recipe = std::move(*read);
  }
  if (pipeline) {
    if (!Pipeline::parse(*pipeline, why)) throw py::value_error(why);
    recipe.pipeline = pipeline;
  }
  add_options(recipe, options_of_keywords(options), {"input", "output", "messages"});
  Flags flags = flags_of(recipe, target);
  flags.inputs = {source};
  std::vector<MessageView> said;
  bool good = false;
  {
    py::gil_scoped_release others;
    Session s(flags);
    good = prepare_conversion(s) && convert_world(s);
    said = views(s.diag());
  }
  if (!good) fail(source + ": nothing could be made of it", said);
  return said;
}

}  // namespace wrlkit::python
