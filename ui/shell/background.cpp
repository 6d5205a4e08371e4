#include "ui/shell/background.hpp"

#include <QCoreApplication>
#include <QThreadPool>

#include <atomic>
#include <deque>
#include <mutex>
#include <utility>

namespace extremal {
namespace {

/// Work on its way to the threads, and messages on their way back. Both wait in queues with a lock that the
/// sanitizer of threads sees, which those inside Qt are hidden from.
class Background : public QObject {
public:
    static Background& ofApplication() {
        if (!current) current = new Background(qApp);
        return *current;
    }
    static Background* existing() { return current; }

    void run(std::function<void()> work) {
        add(work_, std::move(work));
        pool_->start([this] { next(work_)(); });
    }

    void send(std::function<void()> message) {
        add(messages_, std::move(message));
        QCoreApplication::postEvent(this, new QEvent(QEvent::User));
    }

protected:
    /// One message an event, so that those of an event loop inside of one come in turn.
    void customEvent(QEvent*) override { next(messages_)(); }

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

    static std::atomic<Background*> current;

    std::mutex mutex_;
    Queue work_, messages_;  ///< guarded by the mutex
    QThreadPool* pool_;
};

std::atomic<Background*> Background::current{nullptr};

}  // namespace

void runInBackground(std::function<void()> work) { Background::ofApplication().run(std::move(work)); }

void sendToWindow(std::function<void()> message) {
    if (Background* background = Background::existing()) background->send(std::move(message));
}

}  // namespace extremal
