// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/plots/replot_queue.hpp"

#include <qcustomplot.h>

#include <QApplication>
#include <QPointer>
#include <QTimer>

#include <algorithm>
#include <deque>

namespace extremal {
namespace {

class Queue : public QObject {
public:
    explicit Queue(QObject* parent) : QObject(parent) {
        timer_.setInterval(0);
        connect(&timer_, &QTimer::timeout, this, &Queue::work);
    }
    void add(QCustomPlot& plot) {
        if (std::find(waiting_.begin(), waiting_.end(), &plot) == waiting_.end())
            waiting_.emplace_back(&plot);
        timer_.start();
    }

private:
    void work() {
        while (!waiting_.empty() && !waiting_.front()) waiting_.pop_front();
        if (!waiting_.empty()) {
            const QPointer<QCustomPlot> plot = waiting_.front();
            waiting_.pop_front();
            plot->replot();
        }
        if (waiting_.empty()) timer_.stop();
    }

    QTimer timer_;
    std::deque<QPointer<QCustomPlot>> waiting_;
};

}  // namespace

void queueReplot(QCustomPlot& plot) {
    static const QPointer<Queue> queue = new Queue(qApp);
    if (queue) queue->add(plot);
}

}  // namespace extremal
