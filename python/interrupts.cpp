#include "python/interrupts.h"

#include <chrono>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <optional>
#include <thread>
#include <utility>

namespace wrlkit::python {
namespace {

namespace py = pybind11;

constexpr auto between_looks = std::chrono::milliseconds(20);  // for signals: soon for a person, and little work

using Work = std::function<void(const std::stop_token&)>;

/// Work that a thread of Python's waits for.
class Waited {
 public:
  py::object run_on_thread(const Work& work);
  py::object run_here(const Work& work);
  void call(const std::function<void()>& f);
  bool is_fault_of_pass(const py::error_already_set& exception);

 private:
  struct Call {
    const std::function<void()>& f;
    bool done = false;
    std::exception_ptr fault{};
  };

  void wait();
  Call* next_call();
  void answer(Call&);
  void look_for_signals();
  py::object end();

  std::stop_source stop_;
  std::mutex mutex_;
  std::condition_variable changed_;
  Call* call_ = nullptr;
  bool done_ = false;
  std::exception_ptr fault_;  // of the work
  // The thread that waits alone knows these, with Python held.
  std::optional<py::error_already_set> interrupt_;  // what ends the work
  py::object cause_ = py::none();                   // what a pass has ended with
};

thread_local Waited* work_of_thread = nullptr;  // that is done on it
thread_local Waited* answering = nullptr;       // whose calls are answered on it

/// Where handlers of signals run.
bool is_main_thread() {
  const auto main = py::module_::import("threading").attr("main_thread")();
  return main.attr("ident").cast<unsigned long>() == PyThread_get_thread_ident();
}

py::object Waited::run_on_thread(const Work& work) {
  std::jthread thread([this, &work] {
    work_of_thread = this;
    try {
      work(stop_.get_token());
    } catch (...) {
      fault_ = std::current_exception();
    }
    const std::scoped_lock lock(mutex_);
    done_ = true;
    changed_.notify_all();
  });
  wait();
  thread.join();
  return end();
}

/// Python takes a thread that asks for it while Python ends away for good, which the middle of C++ does not survive: a
/// thread that is not the main one does not ask before it has to.
py::object Waited::run_here(const Work& work) {
  auto* const before = std::exchange(answering, this);
  try {
    const py::gil_scoped_release others;
    work(stop_.get_token());
  } catch (...) {
    fault_ = std::current_exception();
  }
  answering = before;
  return end();
}

/// What is to be called, null when there is nothing now.
Waited::Call* Waited::next_call() {
  const py::gil_scoped_release others;
  std::unique_lock lock(mutex_);
  changed_.wait_for(lock, between_looks, [this] { return done_ || call_; });
  return call_;
}

void Waited::answer(Call& call) {
  auto* const before = std::exchange(answering, this);
  try {
    call.f();
  } catch (...) {
    call.fault = std::current_exception();
  }
  answering = before;
  const std::scoped_lock lock(mutex_);
  call.done = true;
  call_ = nullptr;
  changed_.notify_all();
}

void Waited::look_for_signals() {
  if (interrupt_ || PyErr_CheckSignals() == 0) return;
  interrupt_.emplace();
  stop_.request_stop();
}

bool Waited::is_fault_of_pass(const py::error_already_set& exception) {
  if (exception.matches(PyExc_Exception)) {
    cause_ = exception.value();
    return true;
  }
  if (!interrupt_) interrupt_ = exception;
  stop_.request_stop();
  return false;
}

void Waited::wait() {
  const auto is_done = [this] {
    const std::scoped_lock lock(mutex_);
    return done_;
  };
  while (!is_done()) {
    if (auto* const call = next_call())
      answer(*call);
    else
      look_for_signals();
  }
}

py::object Waited::end() {
  if (interrupt_) throw *std::exchange(interrupt_, std::nullopt);
  if (fault_) std::rethrow_exception(std::exchange(fault_, nullptr));
  return std::move(cause_);
}

void Waited::call(const std::function<void()>& f) {
  Call call{f};
  std::unique_lock lock(mutex_);
  call_ = &call;
  changed_.notify_all();
  changed_.wait(lock, [&] { return call.done; });
  if (call.fault) std::rethrow_exception(call.fault);
}

}  // namespace

py::object run_interruptibly(const Work& work) {
  Waited waited;
  return is_main_thread() ? waited.run_on_thread(work) : waited.run_here(work);
}

void call_python(const std::function<void()>& f) {
  if (work_of_thread) return work_of_thread->call(f);
  const py::gil_scoped_acquire lock;
  f();
}

bool is_fault_of_pass(const py::error_already_set& exception) {
  return !answering || answering->is_fault_of_pass(exception);
}

}  // namespace wrlkit::python
