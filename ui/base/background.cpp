// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/base/background.hpp"

#include <QCoreApplication>
#include <QThreadPool>

#include <deque>
#include <mutex>
#include <utility>

namespace extremal {
namespace {

/// Work on its way to the threads, and messages on their way back. Both wait in queues with a lock of their
/// own, as the thread sanitizer does not see the locks inside Qt.
class Background : public QObject {
public:
    static Background& ofApplication() {
        if (!current) current = new Background(qApp);
        return *current;
    }

    void run(std::function<void()> work) {
        add(work_, std::move(work));
        pool_->start([this] { next(work_)(); });
    }

    void send(std::function<void()> message) {
        add(messages_, std::move(message));
        announce();
    }

    void hold() { ++holders_; }
    void release() {
        if (--holders_ > 0) return;
        for (; waiting_ > 0; --waiting_) announce();
    }

protected:
    /// One message per event: they stay in order where one of them runs an event loop.
    void customEvent(QEvent*) override {
        if (holders_ > 0)
            ++waiting_;
        else
            next(messages_)();
    }

private:
    using Queue = std::deque<std::function<void()>>;

    explicit Background(QObject* parent) : QObject(parent), pool_(new QThreadPool(this)) {
        pool_->setObjectName(QStringLiteral("background"));
    }
    ~Background() override {
        pool_->waitForDone();
        const std::lock_guard lock(mutex_);
        messages_.clear();
        current = nullptr;
    }

    void announce() { QCoreApplication::postEvent(this, new QEvent(QEvent::User)); }
    void add(Queue& queue, std::function<void()> last) {
        const std::lock_guard lock(mutex_);
        queue.push_back(std::move(last));
    }
    std::function<void()> next(Queue& queue) {
        const std::lock_guard lock(mutex_);
        std::function<void()> first = std::move(queue.front());
        queue.pop_front();
        return first;
    }

    inline static Background* current = nullptr;  ///< written while none of its threads works

    std::mutex mutex_;
    Queue work_, messages_;  ///< guarded by the mutex
    QThreadPool* pool_;
    int holders_ = 0, waiting_ = 0;  ///< of messages; of the window's thread
};

}  // namespace

void runInBackground(std::function<void()> work) { Background::ofApplication().run(std::move(work)); }

void sendToWindow(std::function<void()> message) { Background::ofApplication().send(std::move(message)); }

HeldMessages::HeldMessages() { Background::ofApplication().hold(); }
HeldMessages::~HeldMessages() { Background::ofApplication().release(); }

}  // namespace extremal
