#include "python/world.h"

#include <algorithm>
#include <cmath>

#include "base/text/nearest_name.h"
#include "convert/convert.h"
#include "convert/load.h"
#include "convert/option_text.h"
#include "convert/profiles.h"
#include "scenegraph/verify.h"
#include "tools/cli/python_passes.h"
#include "tools/cli/session.h"
#include "tools/verbs/info.h"
#include "writers/named_files.h"

namespace wrlkit::python {
namespace {

PyObject* error_type = nullptr;
py::object* cause = nullptr;

std::string text_of(const py::handle& value) {
  if (py::isinstance<py::bool_>(value)) return value.cast<bool>() ? "true" : "false";
  return py::str(value);
}

const Profile& profile_of(const std::vector<std::string>& names) {
  const Profile* profile = names.size() == 1 ? find_profile(names[0]) : nullptr;
  if (!profile) throw py::value_error("profile: there is no profile '" + (names.empty() ? "" : names[0]) + "'");
  return *profile;
}

/// Sets options; a profile gives those that are not given otherwise.
void set_options(ConvertOptions& options, const GivenOptions& given) {
  for (const auto& [name, values] : given)
    if (name == "profile") apply_profile(options.save, profile_of(values));
  for (const auto& [name, values] : given) {
    std::string why;
    if (!set_option(options.load, name, values, why) || !set_option(options.save, name, values, why))
      throw py::value_error(why);
  }
}

/// Keywords of Python, which must all be options.
void check_names(const GivenOptions& given, bool of_input_too) {
  for (const auto& [name, values] : given) {
    NearestName nearest(name);
    nearest.consider("profile");
    bool known = has_option<SaveOptions>(name, nearest) || name == "profile";
    if (of_input_too) known |= has_option<LoadOptions>(name, nearest);
    if (!known) throw py::type_error("there is no option '" + name + "'" + nearest.question());
  }
}

void check_output(const std::string& target) {
  if (!output_of(target))
    throw py::value_error("'" + target + "': the name of an output ends in " + output_endings_text());
}

/// Those of `more` take the place of those of the same name.
GivenOptions together(GivenOptions options, const GivenOptions& more) {
  for (const auto& option : more) {
    std::erase_if(options, [&](const auto& o) { return o.first == option.first; });
    options.push_back(option);
  }
  return options;
}

}  // namespace

void define_error(py::module_& module) {
  error_type = PyErr_NewExceptionWithDoc(
      "wrlkit.Error", "Nothing could be made of a world. messages: all messages about it, as a list of Message.",
      PyExc_RuntimeError, nullptr);
  module.attr("Error") = py::reinterpret_borrow<py::object>(error_type);
  cause = new py::object(py::none());
}

void set_cause(py::object exception) { *cause = std::move(exception); }

void fail(const std::string& otherwise, const std::vector<MessageView>& messages) {
  std::string text = otherwise;
  for (const auto& m : messages)
    if (m.severity == Severity::error) {
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

std::shared_ptr<PyWorld> PyWorld::load(const std::string& path, std::vector<std::string> allow, const std::string& unit,
                                       const std::string& up) {
  ConvertOptions options;
  options.load.allow_paths = std::move(allow);
  if (!unit.empty()) set_options(options, {{"unit", {unit}}});
  if (!up.empty()) set_options(options, {{"up", {up}}});
  auto document = [&] {
    py::gil_scoped_release others;
    return wrlkit::load(path, std::move(options.load));
  }();
  if (!document) fail(path + ": no scene can be read from it", document.messages());
  return std::make_shared<PyWorld>(std::move(document));
}

std::vector<MessageView> PyWorld::said_since(std::size_t n) const {
  auto said = views(diag());
  said.erase(said.begin(), said.begin() + static_cast<std::ptrdiff_t>(std::min(n, said.size())));
  return said;
}

PyWorld::Counts PyWorld::run(Pipeline& pipeline) {
  Statistics stats;
  bool good = false;
  const auto said_before = diag().messages().size();
  {
    py::gil_scoped_release others;
    auto ctx = context(stats);
    good = pipeline.run(scene(), ctx) && (!ctx.resources || write_named_files(*ctx.resources, ctx.diag));
  }
  if (!good) fail("the pipeline has failed", said_since(said_before));
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

Document PyWorld::copy() const {
  if (!lent_) return document_->copy();
  World world;
  world.scene = *lent_;
  return Document(std::move(world), *context_);
}

void PyWorld::save(const std::string& path, const py::kwargs& keywords) {
  const auto given = options_of_keywords(keywords);
  check_names(given, false);
  check_output(path);
  ConvertOptions options;
  set_options(options, given);
  Diagnostics faults(diag().shared_sources());
  const auto said_before = diag().messages().size();
  Saved saved;
  bool is_valid = false;
  {
    py::gil_scoped_release others;
    is_valid = verify(scene(), Level::authored, faults);
    if (is_valid) saved = wrlkit::save(copy(), path, options.save);
  }
  if (!is_valid) fail(path + ": the scene is not valid", views(faults));
  if (!saved) fail(path + ": it could not be written", said_since(said_before));
}

py::object PyWorld::info(bool recognise) {
  std::optional<std::string> text;
  {
    py::gil_scoped_release others;
    auto document = copy();
    const auto path = document.path();
    if (const auto made = wrlkit::info(std::move(document), {recognise})) text = info_json(path, *made, diag());
  }
  if (!text) fail("its figures cannot be had", views(diag()));
  return py::module_::import("json").attr("loads")(*text);
}

void PyWorld::report(const std::string& severity, const std::string& text, const py::object& node) {
  if (!node.is_none() && !py::isinstance<PyNode>(node))
    throw py::type_error("World.report(): 'node' should be a Node, not " + shown_value(node));
  const Span where = node.is_none() ? Span{} : scene().where(node.cast<const PyNode&>().id);
  if (severity == "error")
    diag().report(Diag::python_error, where, text);
  else if (severity == "warning")
    diag().report(Diag::python_warning, where, text);
  else if (severity == "lost")
    diag().report(Diag::python_lost, where, text);
  else
    throw py::value_error("'" + severity + "' is not a severity: error, warning or lost");
}

void PyWorld::detach() {
  if (!lent_) return;
  World world;
  world.scene = *lent_;
  document_.emplace(std::move(world));
  lent_ = nullptr;
}

std::vector<MessageView> convert(const std::string& source, const std::string& target, const std::string& recipe_path,
                                 const std::optional<std::string>& pipeline, const py::kwargs& keywords) {
  std::string why;
  Recipe recipe;
  if (!recipe_path.empty()) {
    auto read = read_recipe(recipe_path, why);
    if (!read) throw py::value_error(why.substr(0, why.find_last_not_of('\n') + 1));
    recipe = std::move(*read);
  }
  if (pipeline && !Pipeline::parse(*pipeline, why)) throw py::value_error(why);
  const auto given = options_of_keywords(keywords);
  check_names(given, true);
  check_output(target);
  ConvertOptions options;
  set_options(options, together(std::move(recipe.options), given));
  options.save.pipeline = pipeline ? pipeline : recipe.pipeline;
  for (const auto& flag : recipe.warnings) apply_warning_flag(options.load, flag);
  Converted made;
  {
    py::gil_scoped_release others;
    made = wrlkit::convert(source, target, options);
  }
  if (!made) fail(source + ": nothing could be made of it", made.messages);
  return made.messages;
}

}  // namespace wrlkit::python
