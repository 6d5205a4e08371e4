// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/shell/termination.hpp"

#include <QSocketNotifier>

#include <atomic>
#include <cerrno>
#include <csignal>
#include <utility>

#include <fcntl.h>
#include <unistd.h>

namespace extremal {
namespace {

constexpr int endingSignals[] = {SIGTERM, SIGINT, SIGHUP};

/// What the handler needs: it is called without an object.
std::atomic<int> wakingPipe{-1};
struct sigaction previousActions[std::size(endingSignals)];

void endBySignal(int number) {
    std::signal(number, SIG_DFL);
    std::raise(number);
}

extern "C" void rememberSignal(int number) {
    const int error = errno;
    const auto byte = static_cast<unsigned char>(number);
    if (const int pipe = wakingPipe.load(); pipe >= 0) {
        const ssize_t written = ::write(pipe, &byte, 1);
        static_cast<void>(written);
    }
    std::signal(number, SIG_DFL);  // the next one ends the program
    errno = error;
}

}  // namespace

Termination::Termination(std::function<void()> prepare, std::function<void(int)> end)
    : prepare_(std::move(prepare)), end_(end ? std::move(end) : endBySignal) {
    if (::pipe2(ends_, O_CLOEXEC | O_NONBLOCK) != 0) return;
    notifier_ = std::make_unique<QSocketNotifier>(ends_[0], QSocketNotifier::Read);
    QObject::connect(notifier_.get(), &QSocketNotifier::activated, notifier_.get(), [this] { meet(); });
    wakingPipe = ends_[1];
    for (std::size_t i = 0; i < std::size(endingSignals); ++i) {
        sigaction(endingSignals[i], nullptr, &previousActions[i]);
        if (previousActions[i].sa_handler == SIG_IGN) continue;
        struct sigaction own {};
        own.sa_handler = rememberSignal;
        own.sa_flags = SA_RESTART;
        sigemptyset(&own.sa_mask);
        sigaction(endingSignals[i], &own, nullptr);
    }
}

Termination::~Termination() {
    if (!notifier_) return;
    for (std::size_t i = 0; i < std::size(endingSignals); ++i)
        sigaction(endingSignals[i], &previousActions[i], nullptr);
    wakingPipe = -1;
    for (const int end : ends_) ::close(end);
}

void Termination::meet() {
    unsigned char number = 0;
    if (::read(ends_[0], &number, 1) != 1) return;
    prepare_();
    end_(number);
}

}  // namespace extremal
