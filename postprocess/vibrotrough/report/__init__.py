"""The pages of `vibrotrough report`, `design --page` and `calibrate --page`."""
