#include "child.h"

#include "pixels.h"

#include <csignal>
#include <cstring>
#include <fcntl.h>
#include <poll.h>
#include <string>
#include <sys/wait.h>
#include <unistd.h>

namespace ofx_check {
namespace {

// All lines that the child writes until it ends. False if the time is over first.
bool read_lines(int from, double timeout_s, std::string& text) {
    const double end = seconds_now() + timeout_s;
    for (;;) {
        pollfd waiting{from, POLLIN, 0};
        const double left = end - seconds_now();
        if (left <= 0) return false;
        if (poll(&waiting, 1, int(left * 1000) + 1) < 0) continue;
        if (waiting.revents == 0) continue;
        char bytes[4096];
        const ssize_t count = read(from, bytes, sizeof bytes);
        if (count <= 0) return true;
        text.append(bytes, std::size_t(count));
    }
}

[[noreturn]] void be_child(const Check& check, const Setup& setup, int to) {
    dup2(STDERR_FILENO, STDOUT_FILENO);  // what a plug-in prints is not a finding
    report_to(to);
    watch_memory();
    check.run(setup);
    _exit(0);
}

}  // namespace

void run_check(const Check& check, const Setup& setup, double timeout_s, Outcomes& outcomes) {
    int ends[2];
    if (pipe2(ends, O_CLOEXEC) != 0) return;
    const pid_t child = fork();
    if (child == 0) be_child(check, setup, ends[1]);
    close(ends[1]);
    std::string text;
    const bool in_time = child > 0 && read_lines(ends[0], timeout_s, text);
    if (child > 0 && !in_time) kill(child, SIGKILL);
    close(ends[0]);
    int status = 0;
    if (child > 0) waitpid(child, &status, 0);
    std::string rule = check.rule;
    for (std::size_t begin = 0; begin < text.size();) {
        const std::size_t end = std::min(text.find('\n', begin), text.size());
        const std::string line = text.substr(begin, end - begin);
        take(outcomes, line, check.name);
        if (const std::string tried = tried_rule(line); !tried.empty()) rule = tried;
        begin = end + 1;
    }
    const auto add = [&](const std::string& broken_rule, const std::string& why) {
        take(outcomes, '!' + broken_rule + '\t' + why, check.name);
    };
    const int code = WIFEXITED(status) ? WEXITSTATUS(status) : 0;
    if (!in_time) {
        add("process.returns", "the check took more than " + std::to_string(int(timeout_s)) + " s");
        add(rule, "it did not return");
    } else if (code == kMemoryTouched) {
        add(rule, "the plug-in used memory that is not its own");
    } else if (WIFSIGNALED(status) || code != 0) {
        const std::string why = WIFSIGNALED(status) ? strsignal(WTERMSIG(status)) : "exit";
        add("process.survives", why);
        add(rule, "the process ended: " + why);
    }
}

}  // namespace ofx_check
