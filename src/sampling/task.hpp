/// A coroutine that answers with a T: a chain's algorithm, written as if its density were
/// a plain function, which stops wherever it waits for an evaluation.
///
/// A task starts when it is awaited, and hands back to the task that awaits it when it
/// ends. The outermost task is started by `start`; destroying it ends all within.
#pragma once

#include <coroutine>
#include <exception>
#include <utility>

namespace bemcal::sampling {

template <class T>
class Task;

namespace detail {

/// Goes on with the task that waits for this one, if any.
struct HandBack {
    bool await_ready() const noexcept { return false; }
    template <class Promise>
    std::coroutine_handle<> await_suspend(
        std::coroutine_handle<Promise> ended) const noexcept {
        if (const auto waiting = ended.promise().waiting) return waiting;
        return std::noop_coroutine();
    }
    void await_resume() const noexcept {}
};

struct PromiseBase {
    std::coroutine_handle<> waiting;
    std::exception_ptr error;

    std::suspend_always initial_suspend() const noexcept { return {}; }
    HandBack final_suspend() const noexcept { return {}; }
    void unhandled_exception() { error = std::current_exception(); }
    void rethrow() const {
        if (error) std::rethrow_exception(error);
    }
};

template <class T>
struct Promise : PromiseBase {
    T answer{};
    Task<T> get_return_object();
    void return_value(T value) { answer = std::move(value); }
    T take() {
        rethrow();
        return std::move(answer);
    }
};

template <>
struct Promise<void> : PromiseBase {
    Task<void> get_return_object();
    void return_void() const {}
    void take() const { rethrow(); }
};

}  // namespace detail

template <class T = void>
class [[nodiscard]] Task {
  public:
    using promise_type = detail::Promise<T>;
    using Handle = std::coroutine_handle<promise_type>;

    explicit Task(Handle handle) : handle_(handle) {}
    Task(Task&& other) noexcept : handle_(std::exchange(other.handle_, {})) {}
    Task& operator=(Task&& other) noexcept {
        std::swap(handle_, other.handle_);
        return *this;
    }
    ~Task() {
        if (handle_) handle_.destroy();
    }

    /// The outermost task: runs until it first waits.
    void start() { handle_.resume(); }
    /// Throws what ended the task, if anything did.
    void check() const { handle_.promise().rethrow(); }

    bool await_ready() const noexcept { return false; }
    std::coroutine_handle<> await_suspend(std::coroutine_handle<> waiting) noexcept {
        handle_.promise().waiting = waiting;
        return handle_;
    }
    T await_resume() { return handle_.promise().take(); }

  private:
    Handle handle_;
};

namespace detail {

template <class T>
Task<T> Promise<T>::get_return_object() {
    return Task<T>(std::coroutine_handle<Promise>::from_promise(*this));
}

inline Task<void> Promise<void>::get_return_object() {
    return Task<void>(std::coroutine_handle<Promise>::from_promise(*this));
}

}  // namespace detail

}  // namespace bemcal::sampling
