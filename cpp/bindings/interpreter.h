// Long work without the interpreter's lock, also while the interpreter ends.
//
// A daemon thread outlives the interpreter: whoever asks for its lock then is ended on the spot, in the
// middle of C++ (std::terminate). So at the interpreter's exit running work is waited for, or stopped at its
// next picture or batch, and the threads that did it, or come to do more, rest until the process ends.
#pragma once

#include <exception>

#include <pybind11/pybind11.h>

namespace burnish {

namespace py = pybind11;

/// Unwinds work that is told that the interpreter ends; `Released` keeps it from Python.
struct InterpreterEnds : std::exception {
    const char* what() const noexcept override { return "the interpreter ends"; }
};

/// In place of py::gil_scoped_release.
class Released {
public:
    Released();
    Released(const Released&) = delete;
    Released& operator=(const Released&) = delete;
    ~Released();

private:
    PyThreadState* outer_; // of the one that Held was within, where Python called again
};

/// In place of py::gil_scoped_acquire, on a thread that is within Released.
class Held {
public:
    Held();
    Held(const Held&) = delete;
    Held& operator=(const Held&) = delete;
    ~Held();
};

/// Throws InterpreterEnds once it does, but on the thread that ends it.
void stop_where_interpreter_ends();

/// Has work come to rest when the interpreter ends.
void rest_at_interpreter_exit();

} // namespace burnish
