#include "tools/script_host/sandbox.h"

#include <linux/audit.h>
#include <linux/filter.h>
#include <linux/seccomp.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstddef>
#include <vector>

#include "passes/startup/limits.h"

namespace wrlkit {
namespace {

#if defined(__x86_64__)
constexpr unsigned architecture = AUDIT_ARCH_X86_64;
#elif defined(__aarch64__)
constexpr unsigned architecture = AUDIT_ARCH_AARCH64;
#else
constexpr unsigned architecture = 0;  // no filter; the limits hold
#endif

#if defined(__SANITIZE_ADDRESS__)
constexpr bool sanitized = true;
#elif defined(__has_feature)
constexpr bool sanitized = __has_feature(address_sanitizer);
#else
constexpr bool sanitized = false;
#endif

/// Nobody may raise a limit that is lower already.
bool limit(__rlimit_resource what, rlim_t soft, rlim_t hard) {
  rlimit now{};
  if (getrlimit(what, &now) != 0) return false;
  const rlim_t most = std::min(now.rlim_max, hard);
  const rlimit value{std::min(soft, most), most};
  return setrlimit(what, &value) == 0;
}

/// Every other call fails with EPERM.
constexpr int allowed[] = {SYS_read, SYS_write,      SYS_brk,          SYS_mmap,    SYS_munmap, SYS_mremap,
                           SYS_exit, SYS_exit_group, SYS_rt_sigreturn, SYS_madvise, SYS_futex,  SYS_mprotect};

bool filter_calls() {
  if (architecture == 0 || sanitized) return true;
  std::vector<sock_filter> program{
      BPF_STMT(BPF_LD | BPF_W | BPF_ABS, offsetof(seccomp_data, arch)),
      BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, architecture, 1, 0),
      BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_KILL_PROCESS),
      BPF_STMT(BPF_LD | BPF_W | BPF_ABS, offsetof(seccomp_data, nr)),
  };
  for (const int call : allowed) {
    program.push_back(BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, static_cast<unsigned>(call), 0, 1));
    program.push_back(BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ALLOW));
  }
  program.push_back(BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ERRNO | EPERM));
  const sock_fprog all{static_cast<unsigned short>(program.size()), program.data()};
  // Containers may have a filter of their own that forbids this one: the limits hold all the same.
  return prctl(PR_SET_SECCOMP, SECCOMP_MODE_FILTER, &all) == 0 || errno == EACCES || errno == EINVAL;
}

}  // namespace

bool enter_sandbox() {
  close_range(1, ~0u, 0);
  const bool limited = limit(RLIMIT_CPU, script_seconds, script_seconds + 1) && limit(RLIMIT_NOFILE, 1, 1) &&
                       limit(RLIMIT_FSIZE, 0, 0) && limit(RLIMIT_NPROC, 0, 0) && limit(RLIMIT_CORE, 0, 0) &&
                       (sanitized || limit(RLIMIT_AS, script_process_bytes, script_process_bytes));
  return limited && prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) == 0 && filter_calls();
}

}  // namespace wrlkit
