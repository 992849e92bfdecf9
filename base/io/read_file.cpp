#include "base/io/read_file.h"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>

#include "base/io/gunzip.h"

namespace wrlkit {
namespace {

constexpr std::size_t head_size = 64 * 1024;  // read to see whether it is gzip

std::string reason(int error) {
  if (error == ENOENT || error == ENOTDIR) return "there is no such file";
  if (error == EACCES) return "permission denied";
  if (error == ENOMEM) return "there is not enough memory";
  return std::generic_category().message(error);
}

/// An open file; standard input stays open.
class File {
 public:
  explicit File(const std::string& path, int flags = 0) {
    if (path == standard_input)
      fd_ = STDIN_FILENO;
    else if (path.find('\0') != path.npos)
      error_ = ENOENT;
    else if ((fd_ = open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NOCTTY | flags)) < 0)
      error_ = errno;
    if (fd_ >= 0 && fstat(fd_, &stat_) != 0) error_ = errno;
    if (!error_ && S_ISDIR(stat_.st_mode)) error_ = EISDIR;
  }
  ~File() {
    if (fd_ > STDIN_FILENO) close(fd_);
  }
  File(const File&) = delete;

  int error() const { return error_; }
  bool is_regular() const { return S_ISREG(stat_.st_mode); }
  bool is_device() const { return S_ISCHR(stat_.st_mode) || S_ISBLK(stat_.st_mode); }
  /// Size as far as it is known beforehand. Files below /proc are regular and report 0.
  std::uint64_t size() const { return is_regular() ? static_cast<std::uint64_t>(stat_.st_size) : 0; }

  /// Reads up to n bytes; fewer only at the end or after an error.
  std::size_t read(char* to, std::size_t n) {
    std::size_t done = 0;
    while (done < n && !error_) {
      auto got = ::read(fd_, to + done, n - done);
      if (got < 0 && errno != EINTR) error_ = errno;
      if (got == 0) break;
      if (got > 0) done += static_cast<std::size_t>(got);
    }
    return done;
  }

  /// Puts the file's own pages in the place of memory that is the size of the file and begins with a page.
  bool map(const char* to) const {
    void* at = const_cast<char*>(to);
    if (mmap(at, size(), PROT_READ, MAP_PRIVATE | MAP_FIXED, fd_, 0) == MAP_FAILED) return false;
    madvise(at, size(), MADV_SEQUENTIAL);
    return true;
  }

  /// The length of the last gzip member, modulo 4 GiB, as its last four bytes say (RFC 1952, 2.3.1).
  std::uint64_t gzip_size() const {
    unsigned char b[4];
    if (pread(fd_, b, 4, static_cast<off_t>(size()) - 4) != 4) return 0;
    return b[0] | b[1] << 8 | b[2] << 16 | std::uint64_t{b[3]} << 24;
  }

 private:
  int fd_ = -1, error_ = 0;
  struct stat stat_ {};
};

class Reader {
 public:
  Reader(const std::string& path, const ReadLimits& limits, Diagnostics& diag)
      : name_(path == standard_input ? standard_input_name : path), limits_(limits), diag_(diag), file_(path) {}

  /// The text; nothing when it could not be read, which is reported then.
  std::optional<FileText> read() {
    if (file_.error()) return failed(file_.error());
    auto limit = file_.is_device() ? std::min(limits_.max_bytes, limits_.max_device) : limits_.max_bytes;
    if (file_.size() > limit) return too_large(limit, readable_size(file_.size()));
    // One byte more than there should be, so that the end is met without growing.
    if (!text_.reserve(std::max<std::size_t>(file_.size() + 1, head_size))) return failed(ENOMEM);
    text_.added(file_.read(text_.end(), head_size));
    out_.gzip = is_gzip(text_.view());
    if (out_.gzip ? !unzip() : !read_rest(limit)) return std::nullopt;
    if (text_.size() == 0) {
      report(Diag::empty_file);
      return std::nullopt;
    }
    out_.name = name_;
    out_.text = text_.finish();
    return std::move(out_);
  }

  bool can_be_read_again() const { return file_.is_regular() && name_ != standard_input_name; }

  std::nullopt_t too_large(std::uint64_t limit, std::string_view size) {
    report(Diag::too_large, "the file", readable_size(limit), size);
    return std::nullopt;
  }

 private:
  // A message about the file as a whole: an empty source that has its name.
  template <class... A>
  void report(Diag id, const A&... args) {
    diag_.report(id, {diag_.sources().add(name_, 0, nullptr), 0}, args...);
  }

  std::nullopt_t failed(int error) {
    diag_.report(Diag::cannot_read, {}, name_, error == EISDIR ? "it is a directory" : reason(error));
    return std::nullopt;
  }

  /// The file as it was when it was opened.
  bool map_rest() {
    if (!file_.map(text_.view().data())) {
      failed(ENOMEM);
      return false;
    }
    text_.added(file_.size() - text_.size());
    out_.bytes_on_disk = text_.size();
    return true;
  }

  bool read_rest(std::uint64_t limit) {
    if (file_.size() >= limits_.map_from && text_.size() == head_size) return map_rest();
    for (bool more = text_.size() == head_size; more;) {
      if (text_.room() == 0 && !text_.grow()) {
        failed(ENOMEM);
        return false;
      }
      auto room = text_.room();
      auto got = file_.read(text_.end(), std::min<std::uint64_t>(room, limit + 1 - text_.size()));
      text_.added(got);
      if (text_.size() > limit) {
        too_large(limit, "it does not end");
        return false;
      }
      more = got == room;
    }
    if (file_.error()) {
      failed(file_.error());
      return false;
    }
    out_.bytes_on_disk = text_.size();
    return true;
  }

  bool unzip() {
    const std::string head(text_.view());
    text_.cut(0);
    // What the file says about its length is believed as far as its own size makes it likely.
    auto likely = static_cast<std::uint64_t>(static_cast<double>(file_.size()) * limits_.max_ratio);
    if (!text_.reserve(std::min({file_.gzip_size() + 1, likely, limits_.max_unpacked + 1}))) {
      failed(ENOMEM);
      return false;
    }
    auto more = [this](std::span<char> to) { return file_.read(to.data(), to.size()); };
    auto result = gunzip(head, more, {limits_.max_unpacked, limits_.max_ratio, limits_.ratio_from}, text_);
    out_.bytes_on_disk = result.packed;
    if (file_.error()) {
      failed(file_.error());
      return false;
    }
    if (result.state == Gunzip::no_memory) {
      failed(ENOMEM);
      return false;
    }
    if (result.state == Gunzip::damaged) report(Diag::gzip_damaged, result.why);
    if (result.state == Gunzip::too_many_bytes) report(Diag::gzip_bomb, readable_size(limits_.max_unpacked));
    if (result.state == Gunzip::too_high_ratio)
      report(Diag::gzip_bomb, std::to_string(static_cast<int>(limits_.max_ratio)) + " times its size");
    return result.state == Gunzip::whole || text_.size() > 0;
  }

  std::string name_;
  const ReadLimits& limits_;
  Diagnostics& diag_;
  File file_;
  BufferBuilder text_;
  FileText out_;
};

/// What gives the text to a message later. Pipes and devices give it only once.
Sources::Reload reload(const std::string& path, const ReadLimits& limits, bool again, const Buffer& text) {
  if (!again) return [text] { return Sources::Loaded{text.view(), std::make_shared<Buffer>(text)}; };
  return [path, limits] {
    Diagnostics quiet;
    auto file = Reader(path, limits, quiet).read();
    return file ? Sources::Loaded{file->view(), std::make_shared<Buffer>(file->text)} : Sources::Loaded{};
  };
}

}  // namespace

std::optional<FileText> read_file(const std::string& path, const ReadLimits& limits, Diagnostics& diag) {
  Reader reader(path, limits, diag);
  auto file = reader.read();
  if (!file) return std::nullopt;
  auto size = file->view().size();
  file->base = diag.sources().add(file->name, size, reload(path, limits, reader.can_be_read_again(), file->text));
  if (file->base == Span::nowhere) return reader.too_large(ReadLimits::one_text, "all files together");
  return file;
}

std::optional<std::string> read_bytes(const std::string& path, std::uint64_t limit, std::string& why) {
  File file(path, O_NONBLOCK);  // a pipe would wait for a writer
  if (file.error()) {
    why = reason(file.error());
    return std::nullopt;
  }
  if (!file.is_regular()) {
    why = "it is no regular file";
    return std::nullopt;
  }
  if (file.size() > limit) {
    why = "it is larger than " + readable_size(limit);
    return std::nullopt;
  }
  std::string bytes(file.size(), '\0');
  bytes.resize(file.read(bytes.data(), bytes.size()));
  if (file.error()) {
    why = reason(file.error());
    return std::nullopt;
  }
  return bytes;
}

std::string readable_size(std::uint64_t bytes) {
  constexpr std::string_view units[] = {" bytes", " KiB", " MiB", " GiB"};
  std::size_t unit = 0;
  auto tenths = static_cast<double>(bytes) * 10;
  while (unit < 3 && tenths >= 10 * 1024 && (unit > 0 || bytes % 1024 == 0 || bytes >= 10 * 1024)) {
    tenths /= 1024;
    ++unit;
  }
  auto n = static_cast<std::uint64_t>(tenths + 0.5);
  if (n >= 100) n = static_cast<std::uint64_t>(tenths / 10 + 0.5) * 10;
  const auto fraction = n % 10 ? "." + std::to_string(n % 10) : std::string();
  return std::to_string(n / 10) + fraction + std::string(units[unit]);
}

}  // namespace wrlkit
