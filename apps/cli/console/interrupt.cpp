#include "console/interrupt.h"

#include "petzval/output.h"

#include <csignal>
#include <initializer_list>

namespace petzval::cli {
namespace {

volatile std::sig_atomic_t g_signal = 0;

void end_at_once(int signal) {
    remove_unfinished_outputs();
    std::signal(signal, SIG_DFL);
    std::raise(signal);
}

void remember(int signal) {
    if (g_signal != 0) end_at_once(signal);
    g_signal = signal;
}

}  // namespace

void watch_for_interrupts() {
    struct sigaction action = {};
    action.sa_handler = remember;
    action.sa_flags = SA_RESTART;
    sigemptyset(&action.sa_mask);
    for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
        struct sigaction before = {};
        sigaction(signal, nullptr, &before);
        // A shell that starts us in the background may have asked for SIGINT to be ignored, nohup for SIGHUP.
        if (before.sa_handler != SIG_IGN) sigaction(signal, &action, nullptr);
    }
    // Nobody reads the output: ends like any program, after removing half-written files.
    struct sigaction before = {};
    sigaction(SIGPIPE, nullptr, &before);
    if (before.sa_handler != SIG_IGN) std::signal(SIGPIPE, end_at_once);
    std::signal(SIGXFSZ, SIG_IGN);
}

int interrupted_by() { return g_signal; }

}  // namespace petzval::cli
