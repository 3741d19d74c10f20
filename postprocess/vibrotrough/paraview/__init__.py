"""The scene of ParaView that `vibrotrough export` writes, and a script that renders it."""
