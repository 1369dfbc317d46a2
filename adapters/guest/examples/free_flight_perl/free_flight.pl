# SPDX-License-Identifier: MIT
# SPDX-FileCopyrightText: 2026 The Rigor authors
#
# A guest without an SDK, written from PROTOCOL.md: bodies that fly freely and touch nothing, by symplectic Euler and turns
# at constant velocity. Perl's core modules alone.
use strict;
use warnings;
use JSON::PP ();
use List::Util qw(sum0);
use Time::HiRes qw(clock_gettime CLOCK_MONOTONIC);

my $json = JSON::PP->new->utf8;
my %worlds;

# -------------------------------------------------------------------------------------------------- frames
binmode STDIN;
open(my $out, '>&', \*STDOUT) or die "no output: $!";
binmode $out;
open(STDOUT, '>&', \*STDERR) or die "no log: $!";    # what is printed goes to the log

sub read_exactly {
    my ($size) = @_;
    my $bytes = '';
    while (length $bytes < $size) {
        my $n = sysread STDIN, $bytes, $size - length $bytes, length $bytes;
        exit 0 unless $n;
    }
    return $bytes;
}

sub read_frame {
    my ($magic, $header_size, $payload_size) = unpack 'a4 L< Q<', read_exactly(16);
    die "no frame\n" if $magic ne 'RGF1';
    my $header  = $json->decode(read_exactly($header_size));
    my $payload = read_exactly($payload_size);
    my ($at, %arrays) = (0);
    for my $array (@{ $header->{arrays} // [] }) {
        my ($rows, $columns) = @{ $array->{shape} };
        if (($array->{type} // 'f64') eq 'u8') {
            $arrays{ $array->{name} } = substr $payload, $at, $rows;
            $at += $rows;
            next;
        }
        my @values = unpack 'd<*', substr $payload, $at, 8 * $rows * $columns;
        $arrays{ $array->{name} } = [map { [splice @values, 0, $columns] } 1 .. $rows];
        $at += 8 * $rows * $columns;
    }
    return ($header, \%arrays);
}

# Arrays: name, columns, rows; or name and bytes.
sub write_frame {
    my ($header, @arrays) = @_;
    my $payload = '';
    for my $array (@arrays) {
        my ($name, $columns, $rows) = @$array;
        my $bytes = defined $rows ? pack('d<*', map { @$_ } @$rows) : $columns;
        push @{ $header->{arrays} },
          defined $rows
          ? { name => $name, shape => [scalar @$rows, $columns] }
          : { name => $name, type => 'u8', shape => [length $bytes] };
        $payload .= $bytes;
    }
    my $text  = $json->encode($header);
    my $frame = pack('a4 L< Q<', 'RGF1', length $text, length $payload) . $text . $payload;
    while (length $frame) {
        my $n = syswrite $out, $frame or die "no reader: $!";
        substr $frame, 0, $n, '';
    }
}

# ------------------------------------------------------------------------------------------------ geometry
sub plus { my ($a, $b, $scale) = @_; return [map { $a->[$_] + ($scale // 1) * $b->[$_] } 0 .. 2] }
sub cross {
    my ($a, $b) = @_;
    return [map { $a->[($_ + 1) % 3] * $b->[($_ + 2) % 3] - $a->[($_ + 2) % 3] * $b->[($_ + 1) % 3] } 0 .. 2];
}
sub conjugate { my ($w, @v) = @{ $_[0] }; return [$w, map { -$_ } @v] }

sub rotate {
    my ($q, $v) = @_;
    my ($w, @axis) = @$q;
    my $t = [map { 2 * $_ } @{ cross(\@axis, $v) }];
    return plus(plus($v, $t, $w), cross(\@axis, $t));
}

# The orientation after dt at a constant angular velocity.
sub turned {
    my ($q, $w, $dt) = @_;
    my $rate = sqrt sum0(map { $_**2 } @$w) or return $q;
    my $s = sin(0.5 * $rate * $dt) / $rate;
    my ($a, @u) = (cos(0.5 * $rate * $dt), map { $s * $_ } @$w);
    my ($b, @v) = @$q;
    my $new    = [$a * $b - sum0(map { $u[$_] * $v[$_] } 0 .. 2), @{ plus(plus([map { $a * $_ } @v], \@u, $b), cross(\@u, \@v)) }];
    my $length = sqrt sum0(map { $_**2 } @$new);
    return [map { $_ / $length } @$new];
}

# x with m x = v, of a 3 x 3 matrix of 9 numbers, by Cramer's rule.
sub solve {
    my ($m, $v) = @_;
    my @columns = map { my $c = $_; [map { $m->[3 * $_ + $c] } 0 .. 2] } 0 .. 2;
    my $det     = sub { my ($a, $b, $c) = @_; my $n = cross($b, $c); return sum0(map { $a->[$_] * $n->[$_] } 0 .. 2) };
    my $whole   = $det->(@columns);
    return [map { my @with = @columns; $with[$_] = $v; $det->(@with) / $whole } 0 .. 2];
}

# -------------------------------------------------------------------------------------------------- worlds
# A body: what was given, and its position (of the centre of mass), orientation, velocity and angular velocity.
sub set_state {
    my ($body, @state) = @_;
    $body->{q} = [@state[3 .. 6]];
    $body->{x} = plus([@state[0 .. 2]], rotate($body->{q}, $body->{given}{center_of_mass}));
    $body->{v} = [@state[7 .. 9]];
    $body->{w} = [@state[10 .. 12]];
}

sub state_of {
    my ($body) = @_;
    my $origin = plus($body->{x}, rotate($body->{q}, $body->{given}{center_of_mass}), -1);
    return [@$origin, map { @{ $body->{$_} } } qw(q v w)];
}

# The body's angular acceleration times dt under this torque times dt; in two dimensions about z alone.
sub turn_of {
    my ($world, $body, $torque) = @_;
    my $inertia = $body->{given}{inertia};
    return [0, 0, $torque->[2] / $inertia->[8]] if $world->{planar};
    return rotate($body->{q}, solve($inertia, rotate(conjugate($body->{q}), $torque)));
}

sub push_body {
    my ($world, $body, $impulse, $angular) = @_;
    $body->{v} = plus($body->{v}, $impulse, 1 / $body->{given}{mass});
    $body->{w} = plus($body->{w}, turn_of($world, $body, $angular));
}

sub states { return ['states', 13, [map { state_of($_) } @{ $_[0]{bodies} }]] }

my %requests = (
    hello => sub {
        return {
            protocol     => 1,
            engine       => { name => 'free_flight_perl', title => 'Free flight, in Perl', version => '1.0', precision => 'f64', build_notes => "Perl $^V" },
            capabilities => { dynamics => JSON::PP::true, dimensions => [2, 3], gravity_scale => JSON::PP::true, center_of_mass_offset => JSON::PP::true },
        };
    },
    build => sub {
        my ($header) = @_;
        my $scenario = $header->{scenario};
        my $world    = { dt => $header->{dt}, planar => $scenario->{dimension} == 2, bodies => [] };
        for my $given (@{ $scenario->{bodies} }) {
            my $moves = $given->{type} eq 'dynamic';
            my $body  = { given => $given, moves => $moves, g => [map { $moves ? $given->{gravity_scale} * $_ : 0 } @{ $scenario->{gravity} }] };
            my @motion = $moves ? (@{ $given->{velocity} }, @{ $given->{angular_velocity} }) : (0) x 6;
            set_state($body, @{ $given->{position} }, @{ $given->{orientation} }, @motion);
            push @{ $world->{bodies} }, $body;
        }
        $worlds{ $header->{world} } = $world;
        return { scheme => 'symplectic_euler', impulses => JSON::PP::true, set_states => 'kept', snapshots => JSON::PP::true }, states($world);
    },
    step => sub {
        my ($header, $arrays, $world) = @_;
        my ($start, $dt) = (clock_gettime(CLOCK_MONOTONIC), $world->{dt});
        push_body($world, $world->{bodies}[$_->[0]], [map { $dt * $_ } @$_[1 .. 3]], [map { $dt * $_ } @$_[4 .. 6]]) for @{ $arrays->{forces} };
        for my $body (grep { $_->{moves} } @{ $world->{bodies} }) {
            $body->{v} = plus($body->{v}, $body->{g}, $dt);
            $body->{x} = plus($body->{x}, $body->{v}, $dt);
            $body->{q} = turned($body->{q}, $body->{w}, $dt);
        }
        return { seconds => clock_gettime(CLOCK_MONOTONIC) - $start }, states($world);
    },
    impulse => sub {
        my ($header, $arrays, $world) = @_;
        my @impulse = @{ $arrays->{impulse}[0] };
        push_body($world, $world->{bodies}[$header->{body}], [@impulse[0 .. 2]], [@impulse[3 .. 5]]);
        return {}, states($world);
    },
    set_states => sub {
        my ($header, $arrays, $world) = @_;
        for my $i (grep { $world->{bodies}[$_]{moves} } 0 .. $#{ $world->{bodies} }) {
            set_state($world->{bodies}[$i], @{ $arrays->{states}[$i] });
        }
        return {}, states($world);
    },
    save => sub {
        my ($header, $arrays, $world) = @_;
        return {}, ['snapshot', pack 'd<*', map { my $b = $_; map { @{ $b->{$_} } } qw(x q v w) } @{ $world->{bodies} }];
    },
    restore => sub {
        my ($header, $arrays, $world) = @_;
        my @values   = unpack 'd<*', $arrays->{snapshot};
        my $restored = @values == 13 * @{ $world->{bodies} };
        for my $body ($restored ? @{ $world->{bodies} } : ()) {
            $body->{$_} = [splice @values, 0, $_ eq 'q' ? 4 : 3] for qw(x q v w);
        }
        return { restored => $restored ? JSON::PP::true : JSON::PP::false }, states($world);
    },
    contacts  => sub { return {}, ['contacts', 19, []] },
    read_back => sub {
        my ($header, $arrays, $world) = @_;
        my @bodies = map { [$_->{given}{mass}, @{ $_->{given}{center_of_mass} }, @{ $_->{given}{inertia} }, @{ state_of($_) }, @{ $_->{g} }] } @{ $world->{bodies} };
        return {}, ['bodies', 29, \@bodies], ['pairs', 4, []];
    },
    ledger => sub {
        my @exact  = (topic => 'integrator', requested => 'symplectic_euler', resolved => 'symplectic_euler', realisation => 'exact', reason => '');
        my @approx = (topic => 'gyroscopic_term', requested => 'exact rigid-body rotation', resolved => 'none', realisation => 'approximate', reason => 'constant without torque');
        return { lines => [{@exact}, {@approx}] };
    },
    destroy => sub { delete $worlds{ $_[0]{world} }; return {} },
);

for (;;) {
    my ($header, $arrays) = read_frame();
    my $answer = $requests{ $header->{request} };
    my @frame  = eval {
        die "unknown request '$header->{request}'\n" unless $answer;
        $answer->($header, $arrays, defined $header->{world} ? $worlds{ $header->{world} } : undef);
    };
    @frame = ({ error => { code => 'failed', message => "$@" } }) if $@;
    my ($found, @tables) = @frame;
    $found->{id} = $header->{id};
    write_frame($found, @tables);
}
