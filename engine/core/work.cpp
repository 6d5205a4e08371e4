// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/core/work.hpp"

#include <exception>
#include <limits>
#include <utility>

namespace extremal::work {
namespace {

thread_local Account* openAccount = nullptr;

}  // namespace

Account::Account(double most, std::stop_token stop)
    : most_(most), stop_(std::move(stop)), before_(openAccount) {
    openAccount = this;
}

Account::~Account() { openAccount = before_; }

void Account::addWithoutLimit(double units) {
    spent_ += units;
    if (!ofPart_) ofPart_ = &parts_[part_];
    *ofPart_ += units;
}

void Account::add(double units) {
    addWithoutLimit(units);
    if (stop_.stop_requested()) throw Exceeded{true};
    if (spent_ > most_) throw Exceeded{false};
}

void Account::enter(const std::string& part) {
    part_ = part;
    ofPart_ = nullptr;
}

Part::Part(const std::string& pointer) : account_(openAccount) {
    if (!account_) return;
    before_ = account_->part_;
    account_->enter(pointer);
}

Part::~Part() {
    if (account_) account_->enter(before_);
}

void spend(double units) {
    if (openAccount) openAccount->add(units);
}

void spendOnce(const std::string& key, double units) {
    if (openAccount && openAccount->known_.insert(key).second) openAccount->add(units);
}

Measured::Measured()
    : exceptions_(std::uncaught_exceptions()),
      outer_(openAccount),
      inner_(outer_ ? outer_->most_ - outer_->spent_ : std::numeric_limits<double>::infinity(),
             outer_ ? outer_->stop_ : std::stop_token()) {}

Measured::~Measured() {
    if (outer_ && std::uncaught_exceptions() > exceptions_) outer_->addWithoutLimit(inner_.spent());
}

}  // namespace extremal::work
