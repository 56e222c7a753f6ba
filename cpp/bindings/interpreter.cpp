#include "interpreter.h"

#include <atomic>
#include <chrono>
#include <pthread.h>
#include <thread>

namespace burnish {
namespace {

std::atomic<bool> is_ending = false;
std::atomic<int> working = 0; ///< threads within Released
std::atomic<int> calling = 0; ///< those of them within Held, which Python may keep for ever
thread_local bool is_last =
    false; ///< the thread that ends the interpreter: it alone may still ask for the lock
thread_local PyThreadState* released = nullptr;
thread_local int held = 0;

bool must_rest() {
    return is_ending && !is_last;
}

[[noreturn]] void rest() {
    while (true)
        std::this_thread::sleep_for(std::chrono::hours(1));
}

/// A fork has only the one thread of its parent that forked.
void forget_other_threads() {
    working = held;
    calling = held;
}

void wait_for_work() {
    using namespace std::chrono_literals;
    while (working > calling)
        std::this_thread::sleep_for(1ms);
    // A call of Python's that takes long may have been told to wait for something that no longer comes.
    for (int k = 0; k < 1000 && working > 0; ++k)
        std::this_thread::sleep_for(1ms);
}

} // namespace

Released::Released() : outer_(released) {
    if (must_rest()) {
        PyEval_SaveThread();
        rest();
    }
    ++working; // before the lock is let go: who ends the interpreter holds it
    released = PyEval_SaveThread();
}

Released::~Released() {
    if (must_rest()) {
        --working;
        rest();
    }
    PyEval_RestoreThread(released);
    released = outer_;
    --working;
}

Held::Held() {
    PyEval_RestoreThread(released);
    ++calling;
    ++held;
}

Held::~Held() {
    // The interpreter may have ended this thread within Python, and it then no longer has the lock.
    if (py::detail::get_thread_state_unchecked() == released) PyEval_SaveThread();
    --held;
    --calling;
}

void stop_where_interpreter_ends() {
    if (must_rest()) throw InterpreterEnds();
}

void rest_at_interpreter_exit() {
    pthread_atfork(nullptr, nullptr, forget_other_threads);
    const py::cpp_function end([] {
        is_ending = true;
        is_last = true;
        const py::gil_scoped_release release;
        wait_for_work();
    });
    py::module_::import("atexit").attr("register")(end);
}

} // namespace burnish
