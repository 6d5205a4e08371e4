// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/study/study_job.hpp"

#include <algorithm>
#include <atomic>
#include <functional>
#include <mutex>
#include <thread>
#include <utility>

#include "engine/core/problem.hpp"

namespace extremal {
namespace {

/// What has become known, to be told to the window's copy of the study.
using Arrival = std::function<void(Study&)>;
using Announce = std::function<void(Arrival)>;

template <class Kind, class... Arguments>
Arrival taking(Arguments... arguments) {
    return [=](Study& study) { std::get<Kind>(study).take(arguments...); };
}

void run(Sweep& sweep, const Announce& announce, const std::stop_token& stop) {
    sweep.run(
        [&](const ReferenceInfo& info) {
            announce([info, size = sweep.metricSize()](Study& study) {
                std::get<Sweep>(study).take(info);
                std::get<Sweep>(study).takeSize(size);  // what a fifth of it says nothing of is off the front
            });
        },
        [&](std::size_t i, const PointResult& result) { announce(taking<Sweep>(i, result)); }, stop);
}

void run(StabilityStudy& study, const Announce& announce, const std::stop_token& stop) {
    study.run(
        [&](std::size_t i) {
            const std::size_t points = study.rows().size();
            announce(i < points ? taking<StabilityStudy>(i, study.rows()[i].result)
                                : taking<StabilityStudy>(i, study.limits()[i - points].limit));
        },
        stop);
}

void run(LimitsStudy& study, const Announce& announce, const std::stop_token& stop) {
    study.run(
        [&](std::size_t i) {
            announce(taking<LimitsStudy>(study.ground()));
            announce(taking<LimitsStudy>(i, study.rows()[i].result));
        },
        stop);
}

template <class Kind>
void run(Kind& study, const Announce& announce, const std::stop_token& stop) {
    study.run([&](std::size_t i) { announce(taking<Kind>(i, study.rows()[i].result)); }, stop);
}

bool isKnown(const SweepRow& row) { return row.result.status != RunStatus::waiting; }
bool isKnown(const StabilityStudy::Row& row) { return row.result.kind != StabilityClass::waiting; }
bool isKnown(const LinearStudy::Row& row) { return row.isKnown; }
bool isKnown(const ExtremesStudy::Row& row) { return row.isKnown(); }
bool isKnown(const LimitsStudy::Row& row) { return row.isKnown; }

}  // namespace

StudyCount countOf(const Study& study) {
    return std::visit(
        [](const auto& each) {
            const auto known = std::count_if(each.rows().begin(), each.rows().end(),
                                             [](const auto& row) { return isKnown(row); });
            return StudyCount{static_cast<std::size_t>(known), each.rows().size()};
        },
        study);
}

/// One study on its thread, with what the window has not fetched yet.
struct StudyJob::Work {
    explicit Work(Study given) : study(std::move(given)) {
        thread = std::jthread([this](const std::stop_token& stop) { work(stop); });
    }

    void work(const std::stop_token& stop) {
        const Announce announce = [this](Arrival arrival) {
            const std::lock_guard lock(mutex);
            arrived.push_back(std::move(arrival));
        };
        try {
            std::visit([&](auto& each) { run(each, announce, stop); }, study);
        } catch (const InvalidScene& e) {
            const Problem& first = e.problems().front();
            const std::lock_guard lock(mutex);
            problem = first.message + (first.hint.empty() ? "" : " (" + first.hint + ")");
        }
        isFinished = true;
    }

    Study study;
    std::mutex mutex;
    std::vector<Arrival> arrived;  ///< guarded by mutex, as the next
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

void StudyJob::start(Study study) {
    retire();
    study_ = study;
    problem_.clear();
    wasStopped_ = false;
    work_ = std::make_unique<Work>(std::move(study));
    timer_.start();
    emit pointsArrived();
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
    const auto whole = [](const auto& study) { return study.isComplete() ? 1.0 : 0.0; };
    if (work_) return std::visit([](const auto& study) { return study.fraction(); }, work_->study);
    return study_ ? std::visit(whole, *study_) : 0;
}

bool StudyJob::isPreparing() const {
    return work_ && std::visit([](const auto& study) { return study.isPreparing(); }, work_->study);
}

AnnouncedTime StudyJob::announced() const {
    return work_ ? std::visit([](const auto& study) { return study.announced(); }, work_->study)
                 : AnnouncedTime{};
}

void StudyJob::retire() {
    if (!work_) return;
    work_->thread.request_stop();
    stopping_.push_back(std::move(work_));
}

void StudyJob::fetch(Work& work) {
    std::vector<Arrival> arrived;
    {
        const std::lock_guard lock(work.mutex);
        arrived.swap(work.arrived);
        problem_ = QString::fromStdString(work.problem);
    }
    for (const Arrival& each : arrived) each(*study_);
    if (!arrived.empty()) emit pointsArrived();
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
