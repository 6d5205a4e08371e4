#include "ui/study/study_job.hpp"

#include <algorithm>
#include <atomic>
#include <mutex>
#include <thread>
#include <utility>

#include "engine/core/problem.hpp"

namespace extremal {

/// One study on its thread, with what the window has not fetched yet.
struct StudyJob::Work {
    explicit Work(Sweep given) : sweep(std::move(given)) {
        thread = std::jthread([this](const std::stop_token& stop) { run(stop); });
    }

    void run(const std::stop_token& stop) {
        try {
            sweep.run(
                [this](const ReferenceInfo& info) {
                    const std::lock_guard lock(mutex);
                    reference = info;
                },
                [this](std::size_t point, const PointResult& result) {
                    const std::lock_guard lock(mutex);
                    arrived.emplace_back(point, result);
                },
                stop);
        } catch (const InvalidScene& e) {
            const Problem& first = e.problems().front();
            const std::lock_guard lock(mutex);
            problem = first.message + (first.hint.empty() ? "" : " (" + first.hint + ")");
        }
        isFinished = true;
    }

    Sweep sweep;
    std::mutex mutex;
    std::vector<std::pair<std::size_t, PointResult>> arrived;  ///< guarded by mutex, as the next two
    std::optional<ReferenceInfo> reference;
    std::string problem;
    std::atomic<bool> isFinished{false};
    std::jthread thread;
};

StudyJob::StudyJob(QObject* parent) : QObject(parent) {
    constexpr int pollMs = 100;
    timer_.setInterval(pollMs);
    connect(&timer_, &QTimer::timeout, this, &StudyJob::poll);
}

StudyJob::~StudyJob() {
    retire();
    for (const auto& work : stopping_) work->thread.request_stop();
}

void StudyJob::start(const Scene& scene, const SweepOptions& options) {
    Sweep sweep(resolve(scene), options);
    retire();
    sweep_ = sweep;
    problem_.clear();
    wasStopped_ = false;
    work_ = std::make_unique<Work>(std::move(sweep));
    timer_.start();
    emit changed();
}

void StudyJob::stop() {
    if (!work_) return;
    wasStopped_ = true;
    fetch(*work_);
    retire();
    emit changed();
}

double StudyJob::fraction() const {
    if (work_) return work_->sweep.fraction();
    return sweep_ && sweep_->isComplete() ? 1 : 0;
}

void StudyJob::retire() {
    if (!work_) return;
    work_->thread.request_stop();
    stopping_.push_back(std::move(work_));
}

void StudyJob::fetch(Work& work) {
    const std::lock_guard lock(work.mutex);
    if (work.reference) sweep_->take(*work.reference);
    for (auto& [point, result] : work.arrived) sweep_->take(point, std::move(result));
    work.arrived.clear();
    problem_ = QString::fromStdString(work.problem);
}

void StudyJob::poll() {
    std::erase_if(stopping_, [](const auto& work) { return work->isFinished.load(); });
    if (work_) {
        const bool isFinished = work_->isFinished;  // before the points, of which none is then missed
        fetch(*work_);
        if (isFinished) retire();
        emit changed();
    }
    if (!work_ && stopping_.empty()) timer_.stop();
}

}  // namespace extremal
