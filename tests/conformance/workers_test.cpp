// A host's own threads do all the work, and nobody else's.
#include "shots.h"

#include <array>
#include <atomic>
#include <condition_variable>
#include <filesystem>
#include <mutex>
#include <thread>

namespace petzval::conformance {
namespace {

// Two threads of a host, which do not even use the one that calls.
class HostPool : public Workers {
public:
    HostPool() {
        for (std::thread& thread : threads_) thread = std::thread([this] { work(); });
    }
    ~HostPool() override {
        {
            const std::lock_guard lock(mutex_);
            ending_ = true;
        }
        changed_.notify_all();
        for (std::thread& thread : threads_) thread.join();
    }
    int width() const override { return 2; }
    void run(int count, FunctionRef<void(int)> body) override {
        std::unique_lock lock(mutex_);
        EXPECT_EQ(body_, nullptr) << "a loop inside a loop is asked for";
        body_ = &body, count_ = count, next_ = done_ = 0, ++loops_;
        changed_.notify_all();
        changed_.wait(lock, [&] { return done_ == count_; });
        body_ = nullptr;
    }
    int loops() const { return loops_; }
    int most_at_once() const { return most_at_once_; }

private:
    void work() {
        std::unique_lock lock(mutex_);
        for (;;) {
            changed_.wait(lock, [&] { return ending_ || (body_ && next_ < count_); });
            if (ending_) return;
            const int i = next_++;
            most_at_once_ = std::max(most_at_once_, ++at_work_);
            lock.unlock();
            (*body_)(i);
            lock.lock();
            --at_work_, ++done_;
            changed_.notify_all();
        }
    }

    std::mutex mutex_;
    std::condition_variable changed_;
    FunctionRef<void(int)>* body_ = nullptr;
    int count_ = 0, next_ = 0, done_ = 0, loops_ = 0, at_work_ = 0, most_at_once_ = 0;
    bool ending_ = false;
    std::array<std::thread, 2> threads_;
};

std::size_t threads_of_this_process() {
    std::size_t n = 0;
    for ([[maybe_unused]] const auto& t : std::filesystem::directory_iterator("/proc/self/task")) ++n;
    return n;
}

// A lens whose kernels differ over the picture, so that all stages have work.
DefocusJob busy_job(const Shot& shot, const std::string& engine) {
    DefocusJob job = shot.job(engine);
    job.pupil_points = 64;
    job.lens.cats_eye = 0.5;
    job.lens.aperture.blades = 6;
    return job;
}

TEST(LentWorkers, DoAllOfADefocusAndGiveTheSameBits) {
    Shot shot = noise_at_several_depths();
    put_behind(
        shot,
        [](int x, int y) {
            return Rgba{0.1f * float(x % 7), 0.1f * float(y % 5), 0.3f, 1};
        },
        [](int, int) { return 9.0f; });
    for (const std::string& engine : engine_names()) {
        DefocusJob job = busy_job(shot, engine);
        HostPool pool;
        job.workers = &pool;
        const std::size_t before = threads_of_this_process();
        const Picture lent = rendered(job);
        EXPECT_EQ(threads_of_this_process(), before) << engine << " started threads of its own";
        EXPECT_GT(pool.loops(), 3) << engine;
        EXPECT_LE(pool.most_at_once(), pool.width()) << engine;
        job.workers = nullptr, job.threads = 1;
        EXPECT_EQ(largest_difference(lent, rendered(job)), 0) << engine;
        EXPECT_EQ(threads_of_this_process(), before) << engine << " needs no more than one thread";
    }
}

}  // namespace
}  // namespace petzval::conformance
