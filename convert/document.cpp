#include "convert/document.h"

#include "convert/embedded_pictures.h"
#include "convert/placing.h"
#include "parsers/resources.h"
#include "passes/lower_vrml1/lower_vrml1.h"

namespace wrlkit {

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
    if (options.strict) own_diag.warnings_are_errors();
    for (const auto& [id, severity] : options.severities) own_diag.set_severity(id, severity);
  }
  State(World w, PassContext c) : world(std::make_unique<World>(std::move(w))), context(std::move(c)) {}

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
Document::Document(World world) : Document(LoadOptions{}) {
  state_->own_diag = Diagnostics(world.scene.sources);
  state_->open_files(std::string(standard_input));
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
  state_->open_files(std::string(standard_input));
  return state_->take(parse_world(bytes, std::move(name), state_->reading(), diag()));
}

Document Document::copy() const {
  Document out(*state_->world, state_->context);
  out.state_->path = state_->path;
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
