! Equation 7 for AUTO-07p
!
! A boundary-value problem over one period (IPS = 4): U(i)(1) = U(i)(0), with the time t/T as the
! last unknown, since AUTO's equations may not depend on time, and the speed of rotation
! PAR(1) = f [Hz] as the parameter. Derivatives are with respect to the phase wt, so that the unit
! interval is one period at any speed:
!
!   U(1:2)  x_s, y_s over the size of the bodies' motion   U(5:6)  their derivatives
!   U(3:4)  x_r - x_s, y_r - y_s over that of the contact   U(7:8)  theirs        U(9)  t/T
!
! The relative motion is an unknown of its own because AUTO measures its steps in the unknowns: the
! folds of the branch are narrow in the speed and wide in the relative motion alone. With x_r, y_r
! AUTO steps over them and turns back. PAR(2:5) are the half peak-to-peak of x_s, y_s, x_r, y_r [m].
! Module machine (mass, stiffness, ...) is written from the parameter file.
module bearing
  use machine
  implicit none
  double precision, parameter :: body = 1d-3, relative = 1d-6  ! [m]
  double precision, parameter :: turn = 6.28318530717958648d0
  double precision, save :: ball_cos(balls), ball_sin(balls)
  logical, save :: ready = .false.

contains

  subroutine prepare
    integer :: j
    if (ready) return
    ball_cos = [(cos(turn*(j - 1)/balls), j = 1, balls)]
    ball_sin = [(sin(turn*(j - 1)/balls), j = 1, balls)]
    ready = .true.
  end subroutine

  ! Eq. 6 in the frame of the cage: sums over the loaded balls, without the contact stiffness.
  subroutine sum_balls(v, force, slope)
    double precision, intent(in) :: v(2)
    double precision, intent(out) :: force(2), slope(3)
    double precision :: p, root
    integer :: j
    force = 0
    slope = 0
    do j = 1, balls
      p = ball_cos(j)*v(1) + ball_sin(j)*v(2) - clearance
      if (p <= 0) cycle
      root = sqrt(p)
      force = force + p*root*[ball_cos(j), ball_sin(j)]
      slope = slope + root*[ball_cos(j)**2, ball_cos(j)*ball_sin(j), ball_sin(j)**2]
    end do
  end subroutine

  ! Force on the stator [N] and its derivative [N/m] for the relative displacement u [m].
  subroutine reaction(angle, u, force, stiffness)
    double precision, intent(in) :: angle, u(2)
    double precision, intent(out) :: force(2), stiffness(2, 2)
    double precision :: c, s, sums(2), slope(3), k
    call prepare
    force = 0
    stiffness = 0
    if (u(1)**2 + u(2)**2 <= clearance**2) return
    c = cos(angle)
    s = sin(angle)
    call sum_balls([c*u(1) + s*u(2), c*u(2) - s*u(1)], sums, slope)
    force = contact_stiffness*[c*sums(1) - s*sums(2), s*sums(1) + c*sums(2)]
    k = 1.5d0*contact_stiffness
    stiffness(1, 1) = k*(c*c*slope(1) + s*s*slope(3) - 2*c*s*slope(2))
    stiffness(1, 2) = k*(c*s*(slope(1) - slope(3)) + (c*c - s*s)*slope(2))
    stiffness(2, 1) = stiffness(1, 2)
    stiffness(2, 2) = k*(s*s*slope(1) + c*c*slope(3) + 2*c*s*slope(2))
  end subroutine

  ! Derivatives of the right-hand sides with respect to U.
  subroutine slopes_u(u, omega, force, stiffness, dfdu)
    double precision, intent(in) :: u(9), omega, force(2), stiffness(2, 2)
    double precision, intent(out) :: dfdu(9, 9)
    double precision :: turning(2), both, phase
    integer :: i
    phase = turn*u(9)
    both = 1/m_s + 1/m_r
    turning = cage_ratio*([-force(2), force(1)] &
                          + relative*matmul(stiffness, [u(4), -u(3)]))
    dfdu = 0
    dfdu(5:6, 3:4) = turn*relative/(body*m_s*omega**2)*stiffness
    dfdu(7:8, 3:4) = -turn*both/omega**2*stiffness
    dfdu(5:6, 9) = turn**2/(body*m_s*omega**2)*turning
    dfdu(7:8, 9) = -turn**2*both/(relative*omega**2)*turning &
                   + turn**2*unbalance/(relative*m_r)*[-sin(phase), cos(phase)]
    do i = 1, 2
      dfdu(i, 4 + i) = turn
      dfdu(2 + i, 6 + i) = turn
      dfdu(4 + i, i) = -turn*k_s/(m_s*omega**2)
      dfdu(4 + i, 4 + i) = -turn*c_s/(m_s*omega)
      dfdu(6 + i, i) = turn*body/relative*(k_s/m_s - k_r/m_r)/omega**2
      dfdu(6 + i, 2 + i) = dfdu(6 + i, 2 + i) - turn*k_r/(m_r*omega**2)
      dfdu(6 + i, 4 + i) = turn*body/relative*(c_s/m_s - c_r/m_r)/omega
      dfdu(6 + i, 6 + i) = -turn*c_r/(m_r*omega)
    end do
  end subroutine

  ! Half peak-to-peak of q, whose highest and lowest points are refined by q' and its slope.
  double precision function half_extent(q, dq, time)
    double precision, intent(in) :: q(:), dq(:), time(:)
    integer :: high, low
    high = maxloc(q, 1)
    low = minloc(q, 1)
    half_extent = 0.5d0*(refined(high) - refined(low))
  contains
    double precision function refined(k)
      integer, intent(in) :: k
      integer :: next, before, count
      double precision :: interval
      count = size(q) - 1  ! the last point is the first
      next = 1 + modulo(k, count)
      before = 1 + modulo(k - 2, count)
      interval = turn*modulo(time(next) - time(before), 1d0)
      refined = q(k) - 0.5d0*dq(k)**2*interval/(dq(next) - dq(before))
    end function
  end function

end module

subroutine func(ndim, u, icp, par, ijac, f, dfdu, dfdp)
  use bearing
  implicit none
  integer, intent(in) :: ndim, icp(*), ijac
  double precision, intent(in) :: u(ndim), par(*)
  double precision, intent(out) :: f(ndim)
  double precision, intent(inout) :: dfdu(ndim, ndim), dfdp(ndim, *)
  double precision :: omega, weight(2), force(2), stiffness(2, 2), whirl(2)
  double precision, dimension(2) :: q_s, q_r, v_s, v_r, a_s, a_r
  omega = turn*par(1)
  q_s = body*u(1:2)
  q_r = q_s + relative*u(3:4)
  v_s = body*u(5:6)
  v_r = v_s + relative*u(7:8)
  call reaction(cage_ratio*turn*u(9), relative*u(3:4), force, stiffness)
  weight = [0d0, gravity]/omega**2
  whirl = unbalance/m_r*[cos(turn*u(9)), sin(turn*u(9))]
  a_s = (force - k_s*q_s)/(m_s*omega**2) - c_s*v_s/(m_s*omega)
  a_r = -(force + k_r*q_r)/(m_r*omega**2) - c_r*v_r/(m_r*omega)
  f(1:4) = turn*u(5:8)
  f(5:6) = turn/body*(a_s - weight)
  f(7:8) = turn/relative*(a_r + whirl - a_s)
  f(9) = 1
  if (ijac == 0) return
  call slopes_u(u, omega, force, stiffness, dfdu)
  if (ijac == 1) return
  ! The accelerations fall with the square of the speed, their damping parts with the speed.
  a_s = -2*a_s - c_s*v_s/(m_s*omega)
  a_r = -2*a_r - c_r*v_r/(m_r*omega)
  dfdp(1:9, 1) = 0
  dfdp(5:6, 1) = turn/body*(a_s + 2*weight)/par(1)
  dfdp(7:8, 1) = turn/relative*(a_r - a_s)/par(1)
end subroutine

subroutine bcnd(ndim, par, icp, nbc, u0, u1, fb, ijac, dbc)
  implicit none
  integer, intent(in) :: ndim, icp(*), nbc, ijac
  double precision, intent(in) :: par(*), u0(ndim), u1(ndim)
  double precision, intent(out) :: fb(nbc)
  double precision, intent(inout) :: dbc(nbc, *)
  integer :: i
  fb(1:8) = u1(1:8) - u0(1:8)
  fb(9) = u0(9)
  if (ijac == 0) return
  dbc(:, 1:2*ndim) = 0
  do i = 1, 8
    dbc(i, i) = -1
    dbc(i, ndim + i) = 1
  end do
  dbc(9, 9) = 1
  if (ijac > 1) dbc(:, 2*ndim + 1) = 0
end subroutine

! U comes with NDX rows and a column for each point of the mesh.
subroutine pvls(ndim, u, par)
  use bearing
  implicit none
  integer, intent(in) :: ndim
  double precision, intent(in) :: u(*)
  double precision, intent(inout) :: par(*)
  double precision, external :: getp
  double precision, allocatable :: q(:, :)
  integer :: i, rows, columns
  rows = nint(getp('NDX', 0, u))
  columns = nint(getp('NTST', 0, u)*getp('NCOL', 0, u)) + 1
  q = reshape(u(1:rows*columns), [rows, columns])
  do i = 1, 2
    par(1 + i) = body*half_extent(q(i, :), q(4 + i, :), q(9, :))
    par(3 + i) = half_extent(body*q(i, :) + relative*q(2 + i, :), &
                             body*q(4 + i, :) + relative*q(6 + i, :), q(9, :))
  end do
end subroutine

! AUTO asks for these; the start comes from a file, and there is neither integral condition nor
! objective.
subroutine stpnt
end subroutine
subroutine icnd
end subroutine
subroutine fopt
end subroutine
