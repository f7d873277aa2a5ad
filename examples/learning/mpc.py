"""Nonlinear model-predictive control of position with a disturbance observer, by CasADi.

    pip install casadi
    uwsim bench circle --algorithm examples/learning/mpc.py:Mpc

At each observation, the controller plans the thrusts of the next `HORIZON` steps of `STEP` that
keep the vehicle near the reference, and applies the first ones. The model is Fossen's (Handbook of
Marine Craft Hydrodynamics and Motion Control, 2011, eq. 6.1 to 6.3) with the numbers of the
vehicle's own file: p and the angles of roll, pitch and yaw from the frame of the scene, z down, and

    M nu' = B u + d - C(nu) nu - D(nu) nu - g.

The wrench d (6) is that of an observer: a fraction `OBSERVER_GAIN` of the error of the predicted
velocity is explained by it, so that it finds the drag of the current. The plan is found by one step
of sequential quadratic programming from the plan before (Diehl et al. 2005, real-time iteration).
The reference is extrapolated by its velocity and acceleration.

Not modelled: the lag of the rotors (0.029 s), and the current, but for its drag in d.
"""

import casadi as ca
import numpy as np

from uwsim.identification.vehicle_model import make_scene, open_vehicle

HORIZON, STEP, PERIOD = 15, 0.1, 0.05  # steps, s, s between observations
OBSERVER_GAIN = 0.2
GRAVITY = 9.81
POSITION_WEIGHT, ANGLE_WEIGHT, TURN_WEIGHT, THRUST_WEIGHT, CHANGE_WEIGHT = 100, 5.0, 1.0, 1e-4, 2e-3


class Model:
    """The equations of motion of a vehicle with one link, as functions of CasADi."""

    def __init__(self, name="bluerov2_heavy"):
        vehicle = open_vehicle(make_scene(name)).hydrodynamics
        body = vehicle.bodies[0]
        inertia = np.diag(body.inertia[:3])
        self._rigid_mass, self._inertia = body.mass, inertia
        self._added_mass = np.diag(body.added_mass)
        self._linear, self._quadratic = (
            np.array(body.linear_damping),
            np.array(body.quadratic_damping),
        )
        self._weight = GRAVITY * body.mass
        self._buoyancy = GRAVITY * body.volume * vehicle.density
        self._centre = ca.DM(list(body.centre_of_buoyancy))
        self.mass = np.diag([body.mass] * 3 + list(body.inertia[:3])) + self._added_mass
        directions = np.array([thruster.direction for thruster in vehicle.thrusters])
        levers = np.cross([thruster.position for thruster in vehicle.thrusters], directions)
        self.allocation = np.hstack([directions, levers]).T  # (6, n)
        curve = np.array(vehicle.thrusters[0].forward)
        self.commands = np.linspace(-1.0, 1.0, 401)
        powers = np.abs(self.commands)[:, None] ** np.arange(1, len(curve) + 1)
        self.thrusts = np.sign(self.commands) * (powers @ curve)
        self.step = self._make_step()

    def command(self, thrusts):
        """Return the commands that give thrusts (n,) [N]."""
        return np.interp(thrusts, self.thrusts, self.commands)

    def _make_step(self):
        """Return the function (state (12), thrusts (n), d (6), time) -> state, by Runge-Kutta."""
        state, thrusts = ca.SX.sym("x", 12), ca.SX.sym("u", self.allocation.shape[1])
        disturbance, time = ca.SX.sym("d", 6), ca.SX.sym("h")
        rate = ca.Function(
            "rate", [state, thrusts, disturbance], [self._rate(state, thrusts, disturbance)]
        )
        k1 = rate(state, thrusts, disturbance)
        k2 = rate(state + 0.5 * time * k1, thrusts, disturbance)
        k3 = rate(state + 0.5 * time * k2, thrusts, disturbance)
        k4 = rate(state + time * k3, thrusts, disturbance)
        result = state + time / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4)
        return ca.Function("step", [state, thrusts, disturbance, time], [result])

    def _rate(self, state, thrusts, disturbance):
        """Return the rate of change of position, angles and twist."""
        roll, pitch = state[3], state[4]
        rotation, nu = rotation_of(state[3:6]), state[6:12]
        velocity, omega = nu[:3], nu[3:]
        p, q, r = nu[3], nu[4], nu[5]
        turn = q * ca.sin(roll) + r * ca.cos(roll)
        angle_rates = ca.vertcat(
            p + turn * ca.tan(pitch), q * ca.cos(roll) - r * ca.sin(roll), turn / ca.cos(pitch)
        )
        added_momentum = self._added_mass @ nu
        linear = self._rigid_mass * velocity + added_momentum[:3]
        angular = self._inertia @ omega + added_momentum[3:]
        coriolis = ca.vertcat(
            ca.cross(omega, linear),
            ca.cross(omega, angular) + ca.cross(velocity, added_momentum[:3]),
        )
        drag = (self._linear + self._quadratic * ca.sqrt(nu * nu + 1e-6)) * nu
        down = rotation[2, :].T
        restoring = ca.vertcat(
            (self._weight - self._buoyancy) * down, -self._buoyancy * ca.cross(self._centre, down)
        )
        wrench = self.allocation @ thrusts + disturbance - coriolis - drag + restoring
        return ca.vertcat(rotation @ velocity, angle_rates, ca.solve(ca.SX(self.mass), wrench))


def rotation_of(angles):
    """Return the rotation from the vehicle to the scene for roll, pitch and yaw [rad]."""
    sx, sy, sz = (ca.sin(angles[i]) for i in range(3))
    cx, cy, cz = (ca.cos(angles[i]) for i in range(3))
    return ca.vertcat(
        ca.horzcat(cz * cy, cz * sy * sx - sz * cx, cz * sy * cx + sz * sx),
        ca.horzcat(sz * cy, sz * sy * sx + cz * cx, sz * sy * cx - cz * sx),
        ca.horzcat(-sy, cy * sx, cy * cx),
    )


class Planner:
    """The quadratic programme whose solution improves a plan."""

    def __init__(self, model):
        n = model.allocation.shape[1]
        states = ca.SX.sym("states", 12, HORIZON + 1)
        thrusts = ca.SX.sym("thrusts", n, HORIZON)
        start, disturbance = ca.SX.sym("start", 12), ca.SX.sym("d", 6)
        references, last_thrusts = (
            ca.SX.sym("references", 3, HORIZON + 1),
            ca.SX.sym("last_thrusts", n),
        )
        yaw = ca.SX.sym("yaw")
        cost, defects = 0.0, [states[:, 0] - start]
        for k in range(HORIZON):
            next_state = model.step(states[:, k], thrusts[:, k], disturbance, STEP)
            defects.append(states[:, k + 1] - next_state)
            thrusts_before = last_thrusts if k == 0 else thrusts[:, k - 1]
            angles = states[3:6, k + 1] - ca.vertcat(0.0, 0.0, yaw)
            cost += POSITION_WEIGHT * ca.sumsqr(states[:3, k + 1] - references[:, k + 1])
            cost += ANGLE_WEIGHT * ca.sumsqr(angles) + TURN_WEIGHT * ca.sumsqr(states[9:, k + 1])
            cost += THRUST_WEIGHT * ca.sumsqr(thrusts[:, k])
            cost += CHANGE_WEIGHT * ca.sumsqr(thrusts[:, k] - thrusts_before)
        plan = ca.vertcat(ca.vec(states), ca.vec(thrusts))
        parameters = ca.vertcat(start, disturbance, ca.vec(references), last_thrusts, yaw)
        defect = ca.vertcat(*defects)
        hessian, gradient = ca.hessian(cost, plan)
        jacobian = ca.jacobian(defect, plan)
        self._derive = ca.Function(
            "derive", [plan, parameters], [hessian, gradient, jacobian, defect]
        )
        problem = {"h": hessian.sparsity(), "a": jacobian.sparsity()}
        osqp = {"verbose": False, "adaptive_rho_interval": 25}  # by iterations, not by the clock
        options = {"osqp": osqp, "error_on_fail": False}
        self._solver = ca.conic("solver", "osqp", problem, options)
        limit = float(model.thrusts[-1])
        state_limits = np.full(12 * (HORIZON + 1), np.inf)
        self._limits = np.concatenate([state_limits, np.full(n * HORIZON, limit)])
        self.plan, self._n = np.zeros(len(self._limits)), n

    def improve(self, parameters):
        """Return the first thrusts of the plan for a start, disturbance and references."""
        hessian, gradient, jacobian, defect = self._derive(self.plan, parameters)
        solution = self._solver(
            h=hessian, g=gradient, a=jacobian, lba=-defect, uba=-defect,
            lbx=-self._limits - self.plan, ubx=self._limits - self.plan,
        )  # fmt: skip
        self.plan = self.plan + np.array(solution["x"]).ravel()
        first = 12 * (HORIZON + 1)
        return np.clip(self.plan[first:], -self._limits[-1], self._limits[-1])[: self._n]


class Mpc:
    """The controller, as a policy on the observations of the four tasks."""

    def __init__(self):
        self.layout = {}  # receives a slice of the observation for each name
        self._model = Model()
        self._planner = Planner(self._model)
        self._disturbance = np.zeros(6)
        self._thrusts = np.zeros(self._model.allocation.shape[1])
        self._prediction = self._reference_velocity = self._yaw = None

    def __call__(self, observation):
        """Return the commands of the thrusters."""
        parts = {name: observation[part] for name, part in self.layout.items()}
        (bow_x, bow_y), gravity = parts["heading"], parts["gravity"]
        angles = [
            np.arctan2(gravity[1], gravity[2]),
            -np.arcsin(gravity[0]),
            np.arctan2(bow_y, bow_x),
        ]
        twist = np.concatenate([parts["linearVelocity"], parts["angularVelocity"]])
        state = np.concatenate([np.zeros(3), angles, twist])
        rotation = np.array(ca.DM(rotation_of(ca.DM(angles))))
        if self._prediction is None:
            self._yaw = angles[2]
        else:
            error = self._model.mass @ (twist - self._prediction[6:]) / PERIOD
            self._disturbance = self._disturbance + OBSERVER_GAIN * error
        references = self._extrapolate(rotation, parts)
        parameters = [state, self._disturbance, references.ravel(), self._thrusts, [self._yaw]]
        self._thrusts = self._planner.improve(np.concatenate(parameters))
        next_state = self._model.step(state, self._thrusts, self._disturbance, PERIOD)
        self._prediction = np.array(next_state).ravel()
        return self._model.command(self._thrusts)

    def _extrapolate(self, rotation, parts):
        """Return the desired positions from the vehicle at the steps of the plan, (steps, 3)."""
        velocity = rotation @ parts.get("referenceVelocity", np.zeros(3))
        last_velocity = velocity if self._reference_velocity is None else self._reference_velocity
        acceleration = (velocity - last_velocity) / PERIOD
        self._reference_velocity = velocity
        times = STEP * np.arange(HORIZON + 1)[:, None]
        offset = rotation @ parts["positionError"]
        return offset + velocity * times + 0.5 * acceleration * times**2
