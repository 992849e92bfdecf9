#include "python/world.h"

#include <algorithm>
#include <cmath>

#include "base/text/nearest_name.h"
#include "convert/convert.h"
#include "convert/load.h"
#include "convert/option_text.h"
#include "convert/profiles.h"
#include "geometry/geometry.h"
#include "python/interrupts.h"
#include "scenegraph/verify.h"
#include "tools/cli/python_passes.h"
#include "tools/cli/session.h"
#include "tools/verbs/info.h"
#include "writers/named_files.h"

namespace wrlkit::python {
namespace {

/// NumPy's numbers and arrays as Python's.
py::object plain(const py::handle& value) {
  return py::hasattr(value, "tolist") ? value.attr("tolist")() : py::reinterpret_borrow<py::object>(value);
}

std::string text_of(const py::handle& value) {
  if (py::isinstance<py::bool_>(value)) return value.cast<bool>() ? "true" : "false";
  return bytes_of(py::str(value));
}

const Profile& profile_of(const std::vector<std::string>& names) {
  const Profile* profile = names.size() == 1 ? find_profile(names[0]) : nullptr;
  if (!profile) throw value_error("profile: there is no profile '" + (names.empty() ? "" : names[0]) + "'");
  return *profile;
}

/// Sets options; a profile gives those that are not given otherwise.
void set_options(ConvertOptions& options, const GivenOptions& given) {
  for (const auto& [name, values] : given)
    if (name == "profile") apply_profile(options.save, profile_of(values));
  for (const auto& [name, values] : given) {
    std::string why;
    if (!set_option(options.load, name, values, why) || !set_option(options.save, name, values, why))
      throw value_error(why);
  }
}

/// Keywords of Python, which must all be options.
void check_names(const GivenOptions& given, bool of_input_too) {
  for (const auto& [name, values] : given) {
    NearestName nearest(name);
    nearest.consider("profile");
    bool known = has_option<SaveOptions>(name, nearest) || name == "profile";
    if (of_input_too) known |= has_option<LoadOptions>(name, nearest);
    if (!known) throw type_error("there is no option '" + name + "'" + nearest.question());
  }
}

void check_output(const std::string& target) {
  if (!output_of(target)) throw value_error("'" + target + "': the name of an output ends in " + output_endings_text());
}

/// Those of `more` take the place of those of the same name.
GivenOptions together(GivenOptions options, const GivenOptions& more) {
  for (const auto& option : more) {
    std::erase_if(options, [&](const auto& o) { return o.first == option.first; });
    options.push_back(option);
  }
  return options;
}

/// What the work has ended with: the last error. That nothing is left of a file is because of the first.
const MessageView* end_of(const std::vector<MessageView>& messages) {
  const auto is_error = [](const MessageView& m) { return m.severity == Severity::error; };
  const auto last = std::ranges::find_if(messages.rbegin(), messages.rend(), is_error);
  if (last == messages.rend()) return nullptr;
  return last->name == info(Diag::nothing_to_write).name ? &*std::ranges::find_if(messages, is_error) : &*last;
}

}  // namespace

void fail(const std::string& otherwise, const std::vector<MessageView>& messages, const py::object& cause) {
  const auto* const end = end_of(messages);
  const auto type = py::module_::import("wrlkit.errors").attr("Error");
  const auto error =
      type(shown_text(end ? end->str() : otherwise), end ? py::cast(*end) : py::object(py::none()), messages);
  if (!cause.is_none()) error.attr("__cause__") = cause;
  PyErr_SetObject(type.ptr(), error.ptr());
  throw py::error_already_set();
}

GivenOptions options_of_keywords(const py::kwargs& keywords) {
  GivenOptions out;
  for (const auto& [key, given] : keywords) {
    auto name = bytes_of(key);
    std::ranges::replace(name, '_', '-');
    const auto value = plain(given);
    std::vector<std::string> values;
    if (py::isinstance<py::list>(value) || py::isinstance<py::tuple>(value))
      for (auto item : value) values.push_back(text_of(plain(item)));
    else
      values.push_back(text_of(value));
    out.emplace_back(std::move(name), std::move(values));
  }
  return out;
}

namespace {

thread_local PyWorld* run_by_thread = nullptr;  // on whose scene passes are run

class RunByThread {
 public:
  explicit RunByThread(PyWorld* world) : before_(std::exchange(run_by_thread, world)) {}
  RunByThread(const RunByThread&) = delete;
  ~RunByThread() { run_by_thread = before_; }

 private:
  PyWorld* before_;
};

LoadOptions load_options(const Reading& reading) {
  ConvertOptions options;
  if (!reading.unit.empty()) set_options(options, {{"unit", {reading.unit}}});
  if (!reading.up.empty()) set_options(options, {{"up", {reading.up}}});
  options.load.allow_paths = reading.allow;
  return options.load;
}

std::shared_ptr<PyWorld> world_of(const std::string& name,
                                  const std::function<Document(const std::stop_token&)>& read) {
  Document document;
  run_interruptibly([&](const std::stop_token& stop) { document = read(stop); });
  if (!document) fail(name + ": no scene can be read from it", document.messages());
  return std::make_shared<PyWorld>(std::move(document));
}

}  // namespace

PyWorld::PyWorld(Document document) : document_(std::move(document)) { remember(document_->messages()); }

std::shared_ptr<PyWorld> PyWorld::load(const std::string& path, const Reading& reading) {
  const auto options = load_options(reading);
  return world_of(path, [&](const std::stop_token& stop) { return wrlkit::load(path, options, {.stop = stop}); });
}

std::shared_ptr<PyWorld> PyWorld::load_bytes(std::string_view bytes, const std::string& name, const Reading& reading) {
  const auto options = load_options(reading);
  return world_of(
      name, [&](const std::stop_token& stop) { return wrlkit::load_bytes(bytes, name, options, {.stop = stop}); });
}

/// The messages of one call: those of the scene's own Diagnostics would be counted only from the fourth of a kind on,
/// and so would be why the fourth call fails.
class PyWorld::Said {
 public:
  explicit Said(PyWorld& world) : world_(world), own_(world.scene().sources), begin_(diag().messages().size()) {}
  Said(const Said&) = delete;
  ~Said() {
    if (!world_.context_) world_.remember(messages());
  }

  Diagnostics& diag() { return world_.context_ ? world_.context_->diag : own_; }
  std::vector<MessageView> messages() {
    auto all = views(diag());
    all.erase(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(begin_));
    return all;
  }

 private:
  PyWorld& world_;
  Diagnostics own_;
  std::size_t begin_;
};

/// Other threads of Python are kept away meanwhile.
class PyWorld::InUse {
 public:
  explicit InUse(PyWorld& world) : world_(world), before_(std::exchange(world.user_, std::this_thread::get_id())) {}
  InUse(const InUse&) = delete;
  ~InUse() { world_.user_ = before_; }

 private:
  PyWorld& world_;
  std::thread::id before_;
};

/// What a pass says of a world belongs to the run that the pass is in.
class PyWorld::InPass {
 public:
  InPass(PyWorld& world, PassContext& ctx) : world_(world), before_(std::exchange(world.context_, &ctx)) {}
  InPass(const InPass&) = delete;
  ~InPass() { world_.context_ = before_; }

 private:
  PyWorld& world_;
  PassContext* before_;
};

std::vector<MessageView> PyWorld::messages() const {
  auto all = messages_;
  if (context_) std::ranges::move(views(context_->diag), std::back_inserter(all));
  return all;
}

void PyWorld::for_pass(Scene& scene, PassContext& ctx, const std::function<void(const std::shared_ptr<PyWorld>&)>& f) {
  auto* const run = run_by_thread;
  const bool is_own = run && &run->scene() == &scene;
  const auto world = is_own ? run->shared_from_this() : std::make_shared<PyWorld>(scene);
  const InPass pass(*world, ctx);
  const auto let_go = [&] {
    if (!is_own && world.use_count() > 1) world->detach();
  };
  try {
    f(world);
  } catch (...) {
    let_go();
    throw;
  }
  let_go();
}

void PyWorld::check_thread() const {
  if (user_ != std::thread::id() && user_ != std::this_thread::get_id())
    throw std::runtime_error("the world is being worked on by another thread; a world is for one thread at a time");
}

void PyWorld::remember(const std::vector<MessageView>& messages) {
  for (const auto& m : messages)
    if (said_.insert(m.str()).second) messages_.push_back(m);
}

PyWorld::Counts PyWorld::run(Pipeline& pipeline) {
  Statistics stats;
  bool good = false;
  Scene& all = scene();
  Said said(*this);
  const InUse use(*this);
  const RunByThread run(this);
  const auto cause = run_interruptibly([&](const std::stop_token& stop) {
    PassContext ctx(said.diag(), stats, resources(), nullptr, stop);
    good = pipeline.run(all, ctx) && (!ctx.resources || write_named_files(*ctx.resources, ctx.diag));
  });
  if (!good) fail("the pipeline has failed", said.messages(), cause);
  return {stats.begin(), stats.end()};
}

PyWorld::Counts PyWorld::run(const std::string& text) {
  std::string why;
  auto pipeline = Pipeline::parse(text, why);
  if (!pipeline) throw value_error(why);
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
  if (!pipeline.add(pass, options, why)) throw value_error(why);
  return run(pipeline);
}

Document PyWorld::copy(const PassContext& ctx) {
  World world;
  if (lent_)
    world.scene = *lent_;
  else
    world = document_->world();
  return Document(std::move(world), ctx);
}

Saved PyWorld::written(const std::string& name, const Sink* sink, const py::kwargs& keywords) {
  const auto given = options_of_keywords(keywords);
  check_names(given, false);
  ConvertOptions options;
  set_options(options, given);
  Saved saved;
  bool is_valid = false;
  Statistics uncounted;
  const Scene& all = scene();
  Diagnostics faults(all.sources);
  Said said(*this);
  const InUse use(*this);
  const auto cause = run_interruptibly([&](const std::stop_token& stop) {
    is_valid = verify(all, Level::authored, faults);
    if (!is_valid) return;
    PassContext ctx(said.diag(), uncounted, resources(), nullptr, stop);
    auto document = copy(ctx);
    saved = sink ? wrlkit::save(document, *sink, name, options.save)
                 : wrlkit::save(std::move(document), name, options.save);
  });
  if (!is_valid) fail(name + ": the scene is not valid", views(faults));
  if (!saved) fail(name + ": it could not be written", said.messages(), cause);
  return saved;
}

void PyWorld::save(const std::string& path, const py::kwargs& keywords) {
  check_output(path);
  written(path, nullptr, keywords);
}

py::bytes PyWorld::to_bytes(const std::string& ending, const py::kwargs& keywords) {
  constexpr std::string_view endings[] = {"glb", "wrl", "x3d"};
  const auto format = ending.starts_with('.') ? ending.substr(1) : ending;
  if (std::ranges::find(endings, format) == std::end(endings))
    throw value_error("World.to_bytes(): 'format' is 'glb', 'wrl' or 'x3d', not '" + ending + "'");
  std::string bytes;
  const Sink sink = [&](std::string_view piece) { bytes += piece; };
  written("." + format, &sink, keywords);
  return bytes;
}

py::object PyWorld::info(bool recognise) {
  std::optional<std::string> text;
  Statistics uncounted;
  check_thread();
  Said said(*this);
  const InUse use(*this);
  run_interruptibly([&](const std::stop_token& stop) {
    PassContext ctx(said.diag(), uncounted, resources(), nullptr, stop);
    if (const auto made = wrlkit::info(copy(ctx), {recognise})) text = info_json(path(), *made, ctx.diag);
  });
  if (!text) fail("its figures cannot be had", said.messages());
  return py::module_::import("json").attr("loads")(text_value(*text));
}

Mesh PyWorld::mesh(NodeId geometry) {
  Mesh out;
  MeshScratch scratch;
  Statistics uncounted;
  Scene& all = scene();
  Said said(*this);
  PassContext ctx(said.diag(), uncounted, resources());
  MeshJob job{all, geometry, out, scratch, ctx};
  read_mesh(job);
  return out;
}

void PyWorld::report(const std::string& severity, const std::string& text, const py::object& node) {
  if (!node.is_none() && !py::isinstance<PyNode>(node))
    throw type_error("World.report(): 'node' should be a Node, not " + shown_value(node));
  const Span where = node.is_none() ? Span{} : scene().where(node.cast<const PyNode&>().id);
  Said said(*this);
  if (severity == "error")
    said.diag().report(Diag::python_error, where, text);
  else if (severity == "warning")
    said.diag().report(Diag::python_warning, where, text);
  else if (severity == "lost")
    said.diag().report(Diag::python_lost, where, text);
  else
    throw value_error("'" + severity + "' is not a severity: error, warning or lost");
}

void PyWorld::detach() {
  if (!lent_) return;
  World world;
  world.scene = *lent_;
  remember(views(context_->diag));
  document_.emplace(std::move(world));
  lent_ = nullptr;
}

std::vector<MessageView> convert(const std::string& source, const std::string& target, const std::string& recipe_path,
                                 const std::optional<std::string>& pipeline, const py::kwargs& keywords) {
  std::string why;
  Recipe recipe;
  if (!recipe_path.empty()) {
    auto read = read_recipe(recipe_path, why);
    if (!read) throw value_error(why.substr(0, why.find_last_not_of('\n') + 1));
    recipe = std::move(*read);
  }
  if (pipeline && !Pipeline::parse(*pipeline, why)) throw value_error(why);
  const auto given = options_of_keywords(keywords);
  check_names(given, true);
  check_output(target);
  ConvertOptions options;
  set_options(options, together(std::move(recipe.options), given));
  options.save.pipeline = pipeline ? pipeline : recipe.pipeline;
  for (const auto& flag : recipe.warnings) apply_warning_flag(options.load, flag);
  Converted made;
  const auto cause = run_interruptibly(
      [&](const std::stop_token& stop) { made = wrlkit::convert(source, target, options, {.stop = stop}); });
  if (!made) fail(source + ": nothing could be made of it", made.messages, cause);
  return made.messages;
}

}  // namespace wrlkit::python
