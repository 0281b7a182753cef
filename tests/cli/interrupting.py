"""Interrupts the program in the middle of its work; shared by the scripts beside it."""

import signal
import subprocess
import time

START_LIMIT = 60  # seconds until the first files are there, on a busy machine
END_LIMIT = 30    # seconds from the interrupt to the end: one step and the closing files


def interrupt(command, folder, is_time, signal_number=signal.SIGINT, after_line=None):
    """Runs a command in a folder, sends the signal once is_time() is true, and returns what was printed.

    `after_line`: a text in the first line of output; from that line on the program knows what to do with a signal.
    The program must end soon, without a word on stderr, with the exit code of the signal.
    """
    process = subprocess.Popen(command, cwd=folder, text=True, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                               stderr=subprocess.PIPE)
    try:
        if after_line:
            heading = process.stdout.readline()
            assert after_line in heading, heading + process.stderr.read()
        deadline = time.monotonic() + START_LIMIT
        while not is_time():
            assert process.poll() is None, "the program ended by itself: " + process.stderr.read()
            assert time.monotonic() < deadline, "nothing was written in time"
            time.sleep(0.05)
        process.send_signal(signal_number)
        output, errors = process.communicate(timeout=END_LIMIT)
    finally:
        process.kill()
    assert process.returncode == 128 + signal_number, f"exit code {process.returncode}: {errors}"
    assert errors == "", errors
    return output
