// Long work while Python waits. Ctrl-C, and every other signal that Python has a handler for, must be heard meanwhile,
// and only the thread that Python calls its main one can run handlers. So the work has a thread of its own, while the
// one that asked for it waits, looks for signals, and stops the work when a handler raises an exception. Where it is
// not the main one, it does the work itself.
//
// Passes in Python run on the thread that waits, not on that of the work: it is the one that the caller's own code runs
// on, with its thread-local state, its database connections, and its KeyboardInterrupt.
#pragma once
#include <pybind11/pybind11.h>

#include <functional>
#include <stop_token>

namespace wrlkit::python {

/// Runs work with Python released, and returns when it has ended: the exception that a pass in Python has ended with,
/// or None. What the work throws is thrown here. An exception of a handler asks the work to stop, and is thrown when it
/// has. Called with Python held.
pybind11::object run_interruptibly(const std::function<void(const std::stop_token&)>& work);

/// For work: calls f with Python held, on the thread that waits for the work; on this one when none does, as in a verb
/// of the program.
void call_python(const std::function<void()>& f);

/// What f has ended with. KeyboardInterrupt and SystemExit are not about a pass: they end the work, and false is
/// returned. Where nobody waits for the work, they are exceptions like all others.
bool is_fault_of_pass(const pybind11::error_already_set& exception);

}  // namespace wrlkit::python
