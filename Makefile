# uwsim: three commands, each doing the set-up it needs first.
#   make demo      play the visibility benchmark and show its table and where the report is
#   make test      every check and every test, as CI runs them
#   make install   set-up alone, into .venv, to use uwsim; the tests also get linters, pytest, Ray and the tools of the site

.PHONY: install demo test

install:
	@scripts/setup

demo: install
	.venv/bin/uwsim bench visibility --seed 1 --out demo.result --overwrite
	@echo "The report: $(CURDIR)/demo.result/report.html"

test:
	@scripts/setup dev docs ray ros2
	@scripts/ros1_peers --if-possible
	@scripts/ros2_messages --if-possible
	scripts/check --all
