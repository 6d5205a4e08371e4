// SPDX-License-Identifier: GPL-3.0-or-later
/// Work that reading a scene takes, counted by those who do it.
///
/// A unit is about one multiplication with an addition in double precision; what is done in quadruple
/// precision or with a hundred digits counts as many as it takes the time of. As operations are counted and
/// not the clock, a scene is refused on every machine or on none. Also a request to stop is met here.
///
/// The account belongs to the thread that reads and is found by `spend`, wherever that is called: the work is
/// done far below the reader, behind catalogues of plain functions. A thread without an account, as in a run,
/// counts nothing. Results that are remembered cost what they cost when they were made (`Measured`), so that
/// what was read before makes no difference.
#pragma once

#include <map>
#include <set>
#include <stop_token>
#include <string>
#include <string_view>

namespace extremal::work {

inline constexpr double quadruple = 64;  ///< units of an operation in quadruple precision
inline constexpr double hundredDigits = 512;

/// The budget of an account is used up, or a stop was requested. No std::exception, so that what turns
/// failures of a computation into findings lets it pass, and nothing remembers it.
struct Exceeded {
    bool isStopped;
};

class Account {
public:
    /// Opens an account for this thread, until it is destroyed; one that was open before is then open again.
    explicit Account(double most, std::stop_token stop = {});
    ~Account();
    Account(const Account&) = delete;
    Account& operator=(const Account&) = delete;

    double spent() const { return spent_; }
    double most() const { return most_; }
    /// What was spent in each part (`Part`), by its name.
    const std::map<std::string, double>& parts() const { return parts_; }

private:
    friend class Measured;
    friend class Part;
    friend void spend(double);
    friend void spendOnce(const std::string&, double);
    void add(double units);

    void addWithoutLimit(double units);
    void enter(const std::string& part);

    double most_, spent_ = 0;
    std::stop_token stop_;
    std::map<std::string, double> parts_;
    std::string part_;          ///< the present one
    double* ofPart_ = nullptr;  ///< its entry; null: nothing was spent in it yet
    std::set<std::string> known_;
    Account* before_;
};

/// While there is one, work counts for this part of what is read: its JSON pointer.
class Part {
public:
    explicit Part(const std::string& pointer);
    ~Part();
    Part(const Part&) = delete;
    Part& operator=(const Part&) = delete;

private:
    Account* account_;
    std::string before_;
};

/// Counts work in the account of this thread. Throws Exceeded.
void spend(double units);
/// The same for a result that is remembered under a key, which an account pays for once.
void spendOnce(const std::string& key, double units);

/// The work of making one result, counted apart, up to what is left to the account of this thread. Where the
/// result is not made, as an exception ends it, the account has spent it all the same.
class Measured {
public:
    Measured();
    ~Measured();
    double spent() const { return inner_.spent(); }

private:
    int exceptions_;
    Account* outer_;
    Account inner_;
};

}  // namespace extremal::work
