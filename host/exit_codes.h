// Exit codes of the program, documented in docs/commands/exit-codes.md.
#pragma once

#include "base/error.h"

namespace jawari::host {

constexpr int exit_code(ErrorKind kind) {
    switch (kind) {
        case ErrorKind::Usage:
            return 2;
        case ErrorKind::InvalidInput:
            return 3;
        case ErrorKind::File:
            return 4;
        case ErrorKind::Internal:
            break;
        case ErrorKind::Device:
            return 6;
        case ErrorKind::Doubtful:
            return 7;
        case ErrorKind::HungUp:
            return 129;
        case ErrorKind::Interrupted:
            return 130;
        case ErrorKind::Terminated:
            return 143;
    }
    return 5;
}

}  // namespace jawari::host
