#include "convert/document.h"

#include <algorithm>
#include <map>

#include "convert/embedded_pictures.h"
#include "convert/placing.h"
#include "parsers/resources.h"
#include "passes/lower_vrml1/lower_vrml1.h"

namespace wrlkit {
namespace {

const std::string no_file;  // of what was read from memory, or made

using NewUrls = std::map<std::string, std::string, std::less<>>;

/// Of all nodes from `first` on.
void rename_urls(Scene& scene, NodeId first, const NewUrls& renamed) {
  for (NodeId n = first; n.value < scene.node_count(); ++n.value)
    for (Value v : scene.copy_of_fields(n)) {
      if (scene.is_extra(v) || v.is || v.type != FieldType::MFString) continue;
      const auto old = v.text_span();
      std::vector<std::string_view> urls(old.begin(), old.end());
      for (auto& url : urls)
        if (const auto now = renamed.find(url); now != renamed.end()) url = now->second;
      if (!std::ranges::equal(urls, old)) scene.set(n, scene.make(v.type, v.slot, urls));
    }
}

}  // namespace

struct Document::State {
  LoadOptions options;
  std::string path;
  Diagnostics own_diag;
  Statistics own_stats;
  std::unique_ptr<World> world;
  std::unique_ptr<FileResources> files;
  std::vector<FileLookup> buffers;
  PassContext context;

  State(LoadOptions o, Watch watch)
      : options(std::move(o)), context(own_diag, own_stats, nullptr, watch.monitor, std::move(watch.stop)) {
    apply_severities();
  }
  State(World w, PassContext c) : context(std::move(c)) {
    if (!context.resources) open_files(no_file);
    world = std::make_unique<World>(std::move(w));
  }

  void apply_severities() {
    if (options.strict) own_diag.warnings_are_errors();
    for (const auto& [id, severity] : options.severities) own_diag.set_severity(id, severity);
  }

  /// A file that another one refers to, in the nodes of VRML97. The only place where that is done.
  std::shared_ptr<const Scene> parse_inlined(const std::string& file, Diagnostics& diag) {
    auto read = read_world(file, {.lookups = &buffers}, diag);
    if (!read) return nullptr;
    if (options.show_all) show_all(read->scene);
    Statistics uncounted;
    PassContext ctx(diag, uncounted);
    lower_vrml1(read->scene, {}, ctx);
    return std::make_shared<const Scene>(std::move(read->scene));
  }

  void open_files(const std::string& input) {
    world.reset();
    files = std::make_unique<FileResources>(
        ResourceOptions{.input = input,
                        .allowed = options.allow_paths,
                        .project = options.project_files,
                        .in_place = options.in_place},
        [this](const std::string& file, Diagnostics& diag) { return parse_inlined(file, diag); });
    context.resources = files.get();
  }

  bool take(std::unique_ptr<World> read) {
    world = std::move(read);
    for (const auto& buffer : buffers) files->files_read().add(buffer.result.canonical);
    if (!world) return false;
    if (options.show_all) show_all(world->scene);
    if (!options.gltf_in_metres || world->format != Format::gltf) place_world(world->scene, options.unit, options.up);
    if (options.unpack_pictures && world->format == Format::gltf) unpack_pictures(world->scene, *files);
    files->set_root({std::shared_ptr<const Scene>{}, &world->scene});
    if (options.run_startup) run_startup(world->scene, context);
    return true;
  }

  ReadOptions reading() { return {.allowed = options.allow_paths, .lookups = &buffers}; }
};

Document::Document(LoadOptions options, Watch watch)
    : state_(std::make_unique<State>(std::move(options), std::move(watch))) {}
Document::Document(World world, const PassContext& context)
    : state_(std::make_unique<State>(std::move(world), context)) {}
Document::Document(World world, LoadOptions options, Watch watch) : Document(std::move(options), std::move(watch)) {
  auto sources = std::make_shared<Sources>();  // which copies of the scene, in other threads, do not share
  sources->add_all(world.scene.sources);
  world.scene.sources = sources;
  state_->own_diag = Diagnostics(std::move(sources));
  state_->apply_severities();
  state_->open_files(no_file);
  state_->take(std::make_unique<World>(std::move(world)));
}
Document::Document(Document&&) noexcept = default;
Document& Document::operator=(Document&&) noexcept = default;
Document::~Document() = default;

void Document::leave_unplaced() {
  state_->options.show_all = false;
  state_->options.run_startup = false;
  state_->options.unit = {};
  state_->options.up = {};
}

bool Document::runs_startup() const { return state_->options.run_startup; }

bool Document::read(const std::string& path) {
  if (auto* monitor = state_->context.monitor) monitor->begin("reading " + path, 0, "");
  state_->world.reset();
  const bool map = state_->options.map_files;
  const auto file = read_file(path, {.map_from = map ? ReadLimits::large : ReadLimits::none_is_mapped}, diag());
  return file && read(path, *file);
}

bool Document::read(const std::string& path, const FileText& file) {
  state_->path = path;
  state_->open_files(path);
  return state_->take(parse_world(file, state_->reading(), diag()));
}

bool Document::parse(std::string_view bytes, std::string name) {
  state_->path = name;
  state_->open_files(no_file);
  return state_->take(parse_world(bytes, std::move(name), state_->reading(), diag()));
}

Document Document::copy() const {
  Document out(*state_->world, state_->context);
  out.state_->path = state_->path;
  return out;
}

Scope Document::import(const Document& other) {
  Scene& scene = this->scene();
  const NodeId first{static_cast<std::uint32_t>(scene.node_count())};
  Scope out = scene.import(other.scene());
  Resources *to = resources(), *from = other.resources();
  if (!to || !from || to == from) return out;
  to->allow(from->folders());
  NewUrls renamed;
  for (const MadeFile& file : from->made()) renamed.emplace(std::string(made_scheme) + file.name, to->add_made(file));
  if (!renamed.empty()) rename_urls(scene, first, renamed);
  return out;
}

Document::operator bool() const { return state_->world != nullptr; }
World& Document::world() { return *state_->world; }
const World& Document::world() const { return *state_->world; }
const std::string& Document::path() const { return state_->path; }
Diagnostics& Document::diag() const { return state_->context.diag; }
Resources* Document::resources() const { return state_->context.resources; }
PassContext& Document::context() { return state_->context; }

void Document::report_files_above() {
  const std::size_t n = state_->files ? state_->files->files_above() : 0;
  if (n) state_->context.diag.report(Diag::url_above, {}, n, state_->files->project());
}

std::vector<FileLookup> Document::lookups() const {
  auto all = state_->files ? state_->files->lookups() : std::vector<FileLookup>();
  all.insert(all.end(), state_->buffers.begin(), state_->buffers.end());
  return all;
}

Ending Document::ending(bool made) const {
  if (!made) return state_->context.stop.stop_requested() ? Ending::stopped : Ending::failed;
  return diag().has_errors() ? Ending::partly : Ending::good;
}

}  // namespace wrlkit
