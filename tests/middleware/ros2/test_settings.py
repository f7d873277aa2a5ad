"""Domain and network, from options and from the variables of ROS 2."""

from __future__ import annotations

import pytest

from uwsim.errors import BadSetting
from uwsim.middleware.ros2.settings import Ros2Settings, settings_from


def test_nothing_set_means_domain_0_of_this_computer() -> None:
    assert settings_from({}) == Ros2Settings(domain=0, is_local=True)


def test_the_option_takes_precedence_over_the_variable() -> None:
    assert settings_from({"ROS_DOMAIN_ID": "7"}).domain == 7
    assert settings_from({"ROS_DOMAIN_ID": "7"}, 9).domain == 9


@pytest.mark.parametrize(
    ("variables", "is_local"),
    [
        ({"ROS_AUTOMATIC_DISCOVERY_RANGE": "SUBNET"}, False),
        ({"ROS_AUTOMATIC_DISCOVERY_RANGE": "LOCALHOST"}, True),
        ({"ROS_LOCALHOST_ONLY": "1", "ROS_AUTOMATIC_DISCOVERY_RANGE": "SUBNET"}, True),
        ({"ROS_LOCALHOST_ONLY": "0"}, False),
    ],
)
def test_the_variables_of_ros_2_choose_the_network(
    variables: dict[str, str], is_local: bool
) -> None:
    settings = settings_from(variables)
    assert settings.is_local is is_local
    assert ("127.0.0.1" in settings.configuration()) is is_local


def test_static_peers_are_looked_for() -> None:
    settings = settings_from({"ROS_STATIC_PEERS": "10.0.0.2; 10.0.0.3"})
    assert settings.static_peers == ("10.0.0.2", "10.0.0.3")
    assert '<Peer address="10.0.0.3"/>' in settings.configuration()


def test_what_the_user_configures_comes_last_and_so_holds() -> None:
    assert settings_from({}).configuration("file:///mine.xml").endswith(",file:///mine.xml")


@pytest.mark.parametrize(
    ("variables", "domain", "message"),
    [
        ({"ROS_DOMAIN_ID": "x"}, None, "ROS_DOMAIN_ID=x: expected a number from 0 to 232."),
        ({"ROS_DOMAIN_ID": "233"}, None, "ROS_DOMAIN_ID=233: expected a number from 0 to 232."),
        ({}, -1, "--domain -1: expected a number from 0 to 232."),
        ({"ROS_LOCALHOST_ONLY": "yes"}, None, "ROS_LOCALHOST_ONLY=yes: expected 1 or 0."),
        (
            {"ROS_AUTOMATIC_DISCOVERY_RANGE": "SUBNETT"},
            None,
            "ROS_AUTOMATIC_DISCOVERY_RANGE=SUBNETT: expected LOCALHOST or SUBNET. "
            "Did you mean 'SUBNET'?",
        ),
    ],
)
def test_a_wrong_value_is_named(
    variables: dict[str, str], domain: int | None, message: str
) -> None:
    with pytest.raises(BadSetting) as error:
        settings_from(variables, domain)
    assert str(error.value) == message
