// Detection of two threads that use one object at a time: a host's mistake that locks of ours would hide, at
// a cost in every call. Objects have it in builds without NDEBUG alone.
#pragma once

#include <atomic>
#include <cstdio>
#include <string>
#include <thread>
#include <vector>

namespace sinew::sim {

/// The thread that uses an object. Its calls may nest.
class OneThread {
public:
    /// A call of a function of the object. If another thread is in such a call, a sentence is written to
    /// stderr and kept, once for an object; both calls go on.
    class Call {
    public:
        Call(OneThread& object, const char* function) noexcept
            : object_(object), isOuter_(object.enter(function)) {}
        ~Call() {
            if (isOuter_) object_.user_.store(std::thread::id{}, std::memory_order_release);
        }
        Call(const Call&) = delete;
        Call& operator=(const Call&) = delete;

    private:
        OneThread& object_;
        bool isOuter_;
    };

    explicit OneThread(const char* name) noexcept : name_(name) {}
    OneThread(const OneThread&) = delete;
    OneThread& operator=(const OneThread&) = delete;

    bool isBroken() const noexcept { return meanwhile_.load() != nullptr; }
    /// The sentence, once. By any thread.
    void takeTo(std::vector<std::string>& sentences) {
        if (isBroken() && !isTold_.exchange(true)) sentences.push_back(sentence());
    }

private:
    // Whether the call is the outermost one of its thread.
    bool enter(const char* function) noexcept {
        std::thread::id before{};
        const std::thread::id self = std::this_thread::get_id();
        if (user_.compare_exchange_strong(before, self, std::memory_order_acquire)) {
            inside_.store(function);
            return true;
        }
        if (before == self) return false;
        const char* none = nullptr;
        if (meanwhile_.compare_exchange_strong(none, function))
            std::fprintf(stderr,
                         "sinew: a %s: %s() is called by a second thread while another one is in %s()\n",
                         name_, function, inside_.load());
        return false;
    }
    std::string sentence() const {
        return std::string("a ") + name_ + ": " + meanwhile_.load() +
               "() was called by a second thread while another one was in a function of the same object: its "
               "state may be wrong: one thread at a time uses it; lock in the host";
    }

    const char* const name_;
    std::atomic<std::thread::id> user_{};
    std::atomic<const char*> inside_{"a function"}; ///< that the user has called
    std::atomic<const char*> meanwhile_{nullptr};   ///< function that a second thread called first
    std::atomic<bool> isTold_{false};
};

#ifdef NDEBUG
/// Costs nothing: see OneThread.
#define SINEW_ONE_THREAD(object)
#else
#define SINEW_ONE_THREAD(object) const ::sinew::sim::OneThread::Call oneThreadCall((object), __func__)
#endif

} // namespace sinew::sim
