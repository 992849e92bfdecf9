#include "base/io/output.h"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <sys/uio.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <filesystem>
#include <system_error>
#include <utility>
#include <vector>

#include "base/io/gzip.h"

namespace wrlkit {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t small = 64 * 1024;  // pieces below this are gathered

class Descriptor {
 public:
  explicit Descriptor(int fd = -1) : fd_(fd) {}
  ~Descriptor() { close(); }
  Descriptor(const Descriptor&) = delete;
  void operator=(int fd) {
    close();
    fd_ = fd;
  }
  operator int() const { return fd_; }
  /// 0, or the error that the system kept until now.
  int close() {
    if (fd_ < 0) return 0;
    return ::close(std::exchange(fd_, -1)) == 0 ? 0 : errno;
  }

 private:
  int fd_;
};

/// Writes all; 0, or the error.
int write_all(int fd, std::span<const std::string_view> pieces) {
  constexpr std::size_t most = 256;  // below any system's IOV_MAX
  std::array<iovec, most> v;
  std::size_t skip = 0;  // bytes of the first piece that are written
  while (!pieces.empty()) {
    std::size_t n = std::min(most, pieces.size());
    for (std::size_t i = 0; i < n; ++i) v[i] = {const_cast<char*>(pieces[i].data()), pieces[i].size()};
    v[0].iov_base = static_cast<char*>(v[0].iov_base) + skip;
    v[0].iov_len -= skip;
    auto written = writev(fd, v.data(), static_cast<int>(n));
    if (written < 0 && errno != EINTR) return errno;
    for (skip += static_cast<std::size_t>(std::max<ssize_t>(written, 0));
         !pieces.empty() && skip >= pieces[0].size();) {
      skip -= pieces[0].size();
      pieces = pieces.subspan(1);
    }
  }
  return 0;
}

std::string reason(int error, const fs::path& path) {
  std::error_code ec;
  const std::string folder = path.has_parent_path() ? path.parent_path().string() : ".";
  if (error == ENOENT && fs::is_directory(folder, ec)) return "no file can be made in the folder '" + folder + "'";
  if (error == ENOENT) return "the folder '" + folder + "' does not exist";
  if (error == EISDIR) return "it is a directory";
  if (error == ENOTDIR) {
    auto file = path.parent_path();
    while (file.has_parent_path() && !fs::exists(file, ec)) file = file.parent_path();
    return "'" + file.string() + "' is not a folder";
  }
  if (error == EACCES && !fs::exists(path, ec)) return "permission denied in the folder '" + folder + "'";
  if (error == EACCES) return "permission denied";
  if (error == ENOSPC && (path.empty() || path == "-")) return "standard output is closed, or its disk is full";
  if (error == ENOSPC) return "the disk is full";
  return std::generic_category().message(error);
}

/// The file that a path means behind symbolic links, which stay.
fs::path behind_links(const std::string& path) {
  std::error_code ec;
  if (!fs::is_symlink(fs::symlink_status(path, ec))) return path;
  auto target = fs::weakly_canonical(path, ec);
  return ec ? fs::path(path) : target;
}

}  // namespace

struct OutputFile::State {
  enum Kind { replace, standard_output, direct };

  std::string name;  // as the user gave it
  const FilesRead* inputs = nullptr;
  FilesWritten* written = nullptr;
  bool is_input = false, is_foreign = false;
  bool report_replaced = false, has_replaced_another = false;
  fs::path target;
  fs::path temporary;  // where the file system does not support files without a name
  Kind kind = replace;
  std::optional<struct stat> replaced;
  Descriptor fd;
  int error = 0;  // the first one
  std::unique_ptr<Gzip> gzip;
  std::string gathered;

  std::vector<fs::path> made_folders;  // the outermost first
  std::string unmade;                  // a folder that could not be made

  ~State() {
    discard();
    std::error_code none;
    while (!made_folders.empty() && fs::remove(made_folders.back(), none)) made_folders.pop_back();
  }

  /// The folder of the target, where it is not there yet. When it cannot be made, that is the error.
  void make_folder() {
    std::vector<fs::path> missing;
    std::error_code fault;
    for (auto at = folder(); !at.empty() && !fs::exists(fs::symlink_status(at, fault)); at = at.parent_path())
      missing.push_back(at);
    fault.clear();
    while (!missing.empty()) {
      if (fs::create_directory(missing.back(), fault)) made_folders.push_back(missing.back());
      if (fault) break;
      missing.pop_back();
    }
    if (!fault || fault == std::errc::not_a_directory) return;
    error = fault.value();
    unmade = missing.back().string();
  }

  void discard() {
    if (!temporary.empty()) unlink(temporary.c_str());
    temporary.clear();
  }

  fs::path folder() const { return target.has_parent_path() ? target.parent_path() : fs::path("."); }
  fs::path temporary_name() const {
    static std::atomic<unsigned> count = 0;
    return folder() / (".wrlkit-" + std::to_string(getpid()) + "-" + std::to_string(count++) + ".tmp");
  }

  void open() {
    if (kind == standard_output) return take(memfd_create("wrlkit", MFD_CLOEXEC));
    struct stat there {};
    if (name.empty() || name.find('\0') != name.npos)
      error = EINVAL;
    else if (name.ends_with('/'))
      error = EISDIR;
    else if (stat(target.c_str(), &there) == 0)
      open_existing(there);
    else if (errno != ENOENT && errno != ENOTDIR)
      error = errno;
    else
      open_temporary();
  }

  void open_existing(const struct stat& there) {
    if (S_ISDIR(there.st_mode))
      error = EISDIR;
    else if (!S_ISREG(there.st_mode)) {
      kind = direct;
      take(::open(target.c_str(), O_WRONLY | O_CLOEXEC | O_NOCTTY));
    } else if (refuses_input() || refuses_foreign())
      return;
    else if (access(target.c_str(), W_OK) != 0)
      error = errno;
    else {
      replaced = there;
      open_temporary();
    }
  }

  /// Whether the target is a file that was read.
  bool refuses_input() {
    std::error_code none;
    const bool is_link = fs::is_symlink(target, none);  // which is replaced
    is_input = inputs && !is_link && inputs->has(target.string());
    if (is_input) error = EEXIST;
    return is_input;
  }

  /// Whether the target is a file that others have made.
  bool refuses_foreign() {
    is_foreign = written && !written->refusal.empty() && !written->has(name);
    if (is_foreign) error = EEXIST;
    return is_foreign;
  }

  void open_temporary() {
    constexpr mode_t everybody = 0666;  // less the umask
    make_folder();
    if (error) return;
    bool can_get_name = access("/proc/self/fd", X_OK) == 0;
    if (can_get_name) fd = ::open(folder().c_str(), O_TMPFILE | O_RDWR | O_CLOEXEC, everybody);
    if (!can_get_name || (fd < 0 && (errno == EOPNOTSUPP || errno == EISDIR || errno == EINVAL))) {
      temporary = temporary_name();
      fd = ::open(temporary.c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, everybody);
      if (fd < 0) temporary.clear();
    }
    if (fd < 0)
      error = errno;
    else if (replaced)
      keep_owner_and_mode();
  }

  // As far as we may: only root can give files away.
  void keep_owner_and_mode() {
    if (fchown(fd, replaced->st_uid, replaced->st_gid) != 0) errno = 0;
    if (fchmod(fd, replaced->st_mode & 0777) != 0) errno = 0;
  }

  void take(int opened) {
    if (opened < 0) error = errno;
    fd = opened;
  }

  Gzip::Put packed() {
    return [this](std::string_view s) { return write_all(fd, {&s, 1}); };
  }

  void put(std::span<const std::string_view> pieces) {
    if (error) return;
    if (!gzip) error = write_all(fd, pieces);
    for (std::size_t i = 0; gzip && !error && i < pieces.size(); ++i) error = gzip->pack(pieces[i], false, packed());
  }

  void flush() {
    if (gathered.empty()) return;
    std::string_view piece = gathered;
    put({&piece, 1});
    gathered.clear();
  }

  void write(std::span<const std::string_view> pieces) {
    std::size_t bytes = gathered.size();
    for (auto p : pieces) bytes += p.size();
    if (bytes >= small) {
      flush();
      put(pieces);
    } else {
      for (auto p : pieces) gathered += p;
    }
  }

  void rewrite(std::uint64_t at, std::string_view bytes) {
    flush();
    while (!error && !bytes.empty()) {
      const auto done = pwrite(fd, bytes.data(), bytes.size(), static_cast<off_t>(at));
      if (done < 0 && errno != EINTR) error = errno;
      const auto n = static_cast<std::size_t>(std::max<ssize_t>(done, 0));
      bytes.remove_prefix(n);
      at += n;
    }
  }

  void finish() {
    flush();
    if (gzip && !error) error = gzip->pack({}, true, packed());
    if (!error && kind == standard_output) copy_to_standard_output();
    if (!error && kind == replace) put_in_place();
    if (int late = fd.close(); late && !error) error = late;
    if (error) return;
    made_folders.clear();
    if (written) written->add(name);
  }

  void copy_to_standard_output() {
    auto size = lseek(fd, 0, SEEK_CUR);
    if (size <= 0) return;
    void* p = mmap(nullptr, static_cast<std::size_t>(size), PROT_READ, MAP_SHARED, fd, 0);
    if (p == MAP_FAILED) {
      error = errno;
      return;
    }
    std::string_view all(static_cast<char*>(p), static_cast<std::size_t>(size));
    error = write_all(STDOUT_FILENO, {&all, 1});
    munmap(p, all.size());
  }

  /// Whether what is written differs from what is there.
  bool differs() const {
    std::array<char, small> ours{}, theirs{};
    const Descriptor there(::open(target.c_str(), O_RDONLY | O_CLOEXEC));
    for (off_t at = 0;; at += static_cast<off_t>(ours.size())) {
      const auto n = pread(fd, ours.data(), ours.size(), at), m = pread(there, theirs.data(), theirs.size(), at);
      if (n != m || n < 0 || !std::equal(ours.begin(), ours.begin() + n, theirs.begin())) return true;
      if (n < static_cast<ssize_t>(ours.size())) return false;
    }
  }

  // A file without a name can be given a new one, but cannot replace another: it gets a temporary name first then.
  void put_in_place() {
    if (refuses_input()) return;  // it may have been read since
    has_replaced_another = report_replaced && replaced && differs();
    if (temporary.empty()) {
      auto self = "/proc/self/fd/" + std::to_string(fd);
      auto link = [&](const fs::path& to) {
        return linkat(AT_FDCWD, self.c_str(), AT_FDCWD, to.c_str(), AT_SYMLINK_FOLLOW) == 0;
      };
      if (!replaced && link(target)) {
        if ((error = fd.close())) unlink(target.c_str());
        return;
      }
      temporary = temporary_name();
      if (!link(temporary)) {
        error = errno;
        return temporary.clear();
      }
    }
    // What comes late, such as a full quota, must come before the old file is gone.
    if ((error = fd.close())) return;
    if (rename(temporary.c_str(), target.c_str()) != 0)
      error = errno;
    else
      temporary.clear();
  }

  bool report(Diagnostics& diag) const {
    const auto why = is_input     ? "it is one of the files that were read; choose another name"
                     : is_foreign ? written->refusal
                     : !unmade.empty()
                         ? "the folder '" + unmade + "' cannot be made: " + std::generic_category().message(error)
                     : kind == direct && error == ENOSPC ? "there is no space left"
                                                         : reason(error, target);
    if (error) diag.report(Diag::cannot_write, {}, name, why);
    if (!error && has_replaced_another) diag.report(Diag::file_replaced, {}, name);
    return error == 0;
  }
};

OutputFile::OutputFile(std::unique_ptr<State> state) : state_(std::move(state)) {}
OutputFile::OutputFile(OutputFile&&) noexcept = default;
OutputFile& OutputFile::operator=(OutputFile&&) noexcept = default;
OutputFile::~OutputFile() = default;

std::optional<OutputFile> OutputFile::open(const std::string& path, OutputOptions options, Diagnostics& diag) {
  auto state = std::make_unique<State>();
  state->name = path;
  state->target = options.written && options.written->replaces_links ? fs::path(path) : behind_links(path);
  state->inputs = options.inputs;
  state->written = options.written;
  state->report_replaced = options.report_replaced;
  if (path == "-") state->kind = State::standard_output;
  if (options.gzip) state->gzip = std::make_unique<Gzip>();
  state->open();
  if (!state->report(diag)) return std::nullopt;
  return OutputFile(std::move(state));
}

void OutputFile::write(std::span<const std::string_view> pieces) { state_->write(pieces); }

bool OutputFile::can_rewrite() const { return !state_->gzip && state_->kind != State::direct; }
void OutputFile::rewrite(std::uint64_t at, std::string_view bytes) { state_->rewrite(at, bytes); }

bool OutputFile::commit(Diagnostics& diag) {
  state_->finish();
  bool done = state_->report(diag);
  state_.reset();
  return done;
}

}  // namespace wrlkit
