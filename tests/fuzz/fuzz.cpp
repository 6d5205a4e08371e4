// SPDX-License-Identifier: GPL-3.0-or-later
/// Long fuzzing: `tool.fuzz KIND COUNT [SEED [FIRST]]`, or KIND all. The cases run in a process of their own
/// with bounded memory; where it dies, takes more than ten seconds of processor time for a case, waits for
/// two minutes without any or finds a fault, the text is kept in fuzz/ below the current folder, and the next
/// case goes on. Prints the counts and the slowest case, those so far where it is ended by SIGINT or SIGTERM;
/// ends with 1 if anything was found.
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <new>
#include <string>
#include <thread>

#include "engine/core/thread_clock.hpp"
#include "tests/fuzz/kinds.hpp"

namespace extremal::fuzz {
namespace {

using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;

constexpr std::size_t mostText = 1 << 20, mostMemory = std::size_t{4} << 30;

/// What the two processes share.
struct Board {
    std::atomic<std::uint64_t> number;  ///< of the case that runs
    std::atomic<std::uint64_t> faults;
    std::atomic<double> slowest;  ///< processor seconds that a case took
    std::atomic<std::uint64_t> slowestNumber;
    std::atomic<std::size_t> length;
    char text[mostText];
};

volatile std::sig_atomic_t isEnded = 0;
void askToEnd(int) { isEnded = 1; }

struct Counts {
    std::uint64_t cases = 0, faults = 0, deaths = 0, hangs = 0;
    double slowest = 0;
    std::uint64_t slowestNumber = 0;
};

class Campaign {
public:
    Campaign(const Kind& kind, std::uint64_t seed)
        : kind_(kind),
          seed_(seed),
          board_(static_cast<Board*>(
              mmap(nullptr, sizeof(Board), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0))) {}
    ~Campaign() { munmap(board_, sizeof(Board)); }
    Campaign(const Campaign&) = delete;
    Campaign& operator=(const Campaign&) = delete;

    Counts run(std::uint64_t first, std::uint64_t count) {
        Counts counts;
        const std::uint64_t end = first + count;
        std::uint64_t at = first;
        while (at < end && isEnded == 0) {
            const pid_t child = fork();
            if (child == 0) cases(at, end);
            const bool isDone = watch(child, counts);
            at = isDone ? end : board_->number + 1;
        }
        counts.cases = at - first;
        counts.faults = board_->faults;
        counts.slowest = board_->slowest;
        counts.slowestNumber = board_->slowestNumber;
        return counts;
    }

private:
    [[noreturn]] void cases(std::uint64_t at, std::uint64_t end) {
        for (const int signal : {SIGINT, SIGTERM}) std::signal(signal, SIG_DFL);
            // A sanitizer's shadow memory is larger than any limit.
#ifndef __SANITIZE_ADDRESS__
        const rlimit memory{mostMemory, mostMemory};
        setrlimit(RLIMIT_AS, &memory);
#endif
        for (; at < end; ++at) {
            const std::string text = makeCase(kind_, seed_, at);
            std::memcpy(board_->text, text.data(), std::min(text.size(), mostText));
            board_->length = std::min(text.size(), mostText);
            board_->number = at;
            const double before = ownSeconds();
            if (const std::string fault = judgeCase(kind_, text); !fault.empty()) {
                ++board_->faults;
                std::printf("%s %llu: %s\n", kind_.name.data(), static_cast<unsigned long long>(at),
                            fault.c_str());
                keep("fault");
            }
            const double took = ownSeconds() - before;
            if (took > board_->slowest) {
                board_->slowest = took;
                board_->slowestNumber = at;
            }
        }
        std::fflush(stdout);
        _exit(0);
    }

    /// Until the child ends. True: by itself.
    bool watch(pid_t child, Counts& counts) {
        std::uint64_t seen = board_->number;
        auto since = Clock::now();
        double used = 0, last = 0;
        for (int status = 0;; std::this_thread::sleep_for(20ms)) {
            if (waitpid(child, &status, WNOHANG) == child) {
                if (WIFEXITED(status) && WEXITSTATUS(status) == 0) return true;
                ++counts.deaths;
                keep("death");
                return false;
            }
            if (isEnded != 0) {
                kill(child, SIGKILL);
                waitpid(child, &status, 0);
                return false;
            }
            const double now = processorSeconds(child);
            if (now > last) {  // it works, however little the machine lets it
                last = now;
                since = Clock::now();
            }
            if (board_->number != seen) {
                seen = board_->number;
                used = now;
            } else if (now - used > 10 || Clock::now() - since > 120s) {
                ++counts.hangs;
                keep("hang");
                kill(child, SIGKILL);
                waitpid(child, &status, 0);
                return false;
            }
        }
    }

    static double processorSeconds(pid_t process) {
        clockid_t clock{};
        return clock_getcpuclockid(process, &clock) == 0 ? secondsOf(clock) : 0;
    }
    static double ownSeconds() { return secondsOf(CLOCK_PROCESS_CPUTIME_ID); }

    void keep(const char* what) const {
        std::filesystem::create_directories("fuzz");
        const std::string name = std::string(kind_.name) + "-" + what + "-" + std::to_string(seed_) + "-" +
                                 std::to_string(board_->number.load()) + ".txt";
        std::ofstream("fuzz/" + name, std::ios::binary)
            .write(board_->text, static_cast<std::streamsize>(board_->length.load()));
        std::printf("kept fuzz/%s\n", name.c_str());
        std::fflush(stdout);
    }

    const Kind& kind_;
    std::uint64_t seed_;
    Board* board_;
};

int main(int argc, char** argv) {
    const std::string wanted = argc > 1 ? argv[1] : "";
    const std::uint64_t count = argc > 2 ? std::strtoull(argv[2], nullptr, 10) : 0;
    const std::uint64_t seed = argc > 3 ? std::strtoull(argv[3], nullptr, 10) : 1;
    const std::uint64_t first = argc > 4 ? std::strtoull(argv[4], nullptr, 10) : 0;
    bool isClean = true, isKnown = false;
    for (const int signal : {SIGINT, SIGTERM}) std::signal(signal, askToEnd);
    for (const Kind& kind : kinds()) {
        if ((wanted != "all" && wanted != kind.name) || isEnded != 0) continue;
        isKnown = count > 0;
        const Counts counts = Campaign(kind, seed).run(first, count);
        std::printf("%s: %llu cases, %llu faults, %llu deaths, %llu hangs; the slowest, %llu, took %.2f s\n",
                    kind.name.data(), static_cast<unsigned long long>(counts.cases),
                    static_cast<unsigned long long>(counts.faults),
                    static_cast<unsigned long long>(counts.deaths),
                    static_cast<unsigned long long>(counts.hangs),
                    static_cast<unsigned long long>(counts.slowestNumber), counts.slowest);
        std::fflush(stdout);
        isClean = isClean && counts.faults + counts.deaths + counts.hangs == 0;
    }
    if (!isKnown) {
        std::fprintf(stderr, "usage: tool.fuzz KIND COUNT [SEED [FIRST]], where KIND is all or one of\n");
        for (const Kind& kind : kinds()) std::fprintf(stderr, "  %s\n", kind.name.data());
        return 2;
    }
    return isClean ? 0 : 1;
}

}  // namespace
}  // namespace extremal::fuzz

int main(int argc, char** argv) { return extremal::fuzz::main(argc, argv); }
